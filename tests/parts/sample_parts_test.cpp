// SPDX-License-Identifier: GPL-3.0-or-later
// The sample pairs: closed files, and at every recorded pose contact without penetration.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "mortise/core/rigid_motion.hpp"
#include "mortise/metrics/true_mates.hpp"
#include "mortise/parts/mesh_solid.hpp"
#include "mortise/parts/read_part.hpp"
#include "mortise/parts/sample_surface.hpp"

namespace mortise {
namespace {

const std::string kFolder = MORTISE_SOURCE_DIR "/parts/";

std::vector<TrueMate> pairs() { return read_true_mates(kFolder + "mates.json"); }

/// The member of a family at `u` in [0, 1]; u = 0 and 1 are the ends of a range.
RigidMotion member_at(const Symmetry& s, double u) {
  if (s.kind == SymmetryKind::kFold) {
    const double number = std::round(u * s.order);
    return member(s, &number);
  }
  const double at[3] = {s.from + u * (s.to - s.from), 0.0, 0.0};
  const double turn[3] = {1.8 * u, 0.0, 2.4 * u};
  return member(s, s.kind == SymmetryKind::kBall ? turn : at);
}

struct Part {
  ReadPartResult file;
  MeshSolid solid;
  Eigen::Matrix3Xd points;
  double diameter;
};

const Part& part(const std::string& stem) {
  static std::map<std::string, Part> parts;
  const auto found = parts.find(stem);
  if (found != parts.end()) return found->second;
  ReadPartResult file = read_part(kFolder + stem + ".stl");
  const Eigen::AlignedBox3d box(file.mesh.vertices.rowwise().minCoeff(),
                                file.mesh.vertices.rowwise().maxCoeff());
  MeshSolid solid(file.mesh);
  Eigen::Matrix3Xd points = sample_surface(file.mesh, 3000).points;
  return parts.emplace(stem, Part{std::move(file), solid, points, box.diagonal().norm()})
      .first->second;
}

struct Fit {
  double depth = 0.0;    ///< of the deepest point of one surface inside the other part
  double contact = 0.0;  ///< part of the moving part's surface that touches the fixed one
};

/// The volume in common is at most depth times the area of both surfaces.
Fit fit_of(const Part& fixed, const Part& moving, const RigidMotion& pose, double touch) {
  const Eigen::VectorXd of_moving =
      fixed.solid.signed_distance(pose * moving.points, std::numeric_limits<double>::infinity());
  const Eigen::VectorXd of_fixed = moving.solid.signed_distance(
      inverse(pose) * fixed.points, std::numeric_limits<double>::infinity());
  Fit fit;
  fit.depth = -std::min(of_moving.minCoeff(), of_fixed.minCoeff());
  fit.contact = static_cast<double>((of_moving.array().abs() < touch).count()) /
                static_cast<double>(of_moving.size());
  return fit;
}

/// The product of members S1 S2 ... Sn, each at its own place of its range.
RigidMotion any_member(const std::vector<Symmetry>& symmetries, int sample) {
  RigidMotion m;
  int n = 0;
  for (const Symmetry& s : symmetries) {
    static constexpr double kPlaces[] = {0.0, 1.0, 0.37, 0.72};
    m = compose(m, member_at(s, kPlaces[static_cast<std::size_t>((sample + n++) % 4)]));
  }
  return m;
}

TEST(SampleParts, EveryFileIsClosedAndTheStepFileIsTheSameSolid) {
  std::set<std::string> stems;
  for (const TrueMate& pair : pairs()) {
    stems.insert(pair.fixed);
    stems.insert(pair.moving);
  }
  EXPECT_GE(stems.size(), 40U);
  ReadPartOptions quick;
  quick.deviation = 2e-3;
  quick.angle = 1.0;
  quick.repair.find_self_intersections = false;
  for (const std::string& stem : stems) {
    const ReadPartResult& stl = part(stem).file;
    EXPECT_TRUE(stl.closed) << stem;
    EXPECT_TRUE(stl.decisions.empty()) << stem << ": " << stl.decisions.front();
    const ReadPartResult step = read_part(kFolder + stem + ".step", quick);
    EXPECT_TRUE(step.closed) << stem;
    EXPECT_EQ(step.unit, "mm") << stem;
    EXPECT_NEAR(step.volume / stl.volume, 1.0, 0.02) << stem;
    EXPECT_LT(
        (step.mesh.vertices.rowwise().maxCoeff() - stl.mesh.vertices.rowwise().maxCoeff()).norm(),
        4e-3 * part(stem).diameter)
        << stem;
  }
}

TEST(SampleParts, FitWithoutPenetrationAtEveryRecordedPose) {
  const std::vector<TrueMate> all = pairs();
  std::set<std::string> families;
  for (const TrueMate& pair : all) {
    const std::string& name = pair.name;
    families.insert(name.substr(0, name.rfind('_')));
    const Part& fixed = part(pair.fixed);
    const Part& moving = part(pair.moving);
    // Both are tessellated to 0.06 mm or better, and clearance opens gaps of up to 0.25 mm.
    const double touch = 0.15 + 0.1 * (pair.clearance / 0.02);
    const int samples = pair.symmetries.empty() ? 1 : 5;
    for (int i = 0; i < samples; ++i) {
      const RigidMotion pose = i == 0
                                   ? pair.moving_in_fixed
                                   : compose(any_member(pair.symmetries, i), pair.moving_in_fixed);
      const Fit fit = fit_of(fixed, moving, pose, touch);
      EXPECT_LT(fit.depth, name.starts_with("thread") ? 0.12 : 0.04) << name << " member " << i;
      // A gear touches along one line per tooth pair; everything else over a good part of it.
      EXPECT_GT(fit.contact, name.starts_with("spur") ? 0.007 : 0.08) << name << " member " << i;
    }
    // The check would notice: a shift by 2% of the diameter, along whichever axis is worst.
    double worst = 0.0;
    for (int axis = 0; axis < 6; ++axis) {
      RigidMotion shifted = pair.moving_in_fixed;
      shifted.translation(axis / 2) += (axis % 2 == 0 ? 0.02 : -0.02) * moving.diameter;
      worst = std::max(worst, fit_of(fixed, moving, shifted, touch).depth);
    }
    EXPECT_GT(worst, 0.2) << name;
  }
  EXPECT_GE(all.size(), 30U);
  EXPECT_GE(families.size(), 16U);
}

// A thread turned the wrong way for its slide, or a gear spun the wrong way for its orbit, cuts
// into its mate: the signs of pitch and ratio are those of the shapes.
TEST(SampleParts, ScrewsAndGearsMeshOneWayRoundOnly) {
  std::set<SymmetryKind> seen;
  for (const TrueMate& pair : pairs())
    for (const Symmetry& s : pair.symmetries) {
      if (s.kind != SymmetryKind::kScrew && s.kind != SymmetryKind::kRoll) continue;
      if (s.pitch == 0.0 && s.ratio == 0.0) continue;  // a hinge
      if (!seen.insert(s.kind).second) continue;       // one of each is enough
      Symmetry wrong = s;
      wrong.pitch = -s.pitch;
      wrong.ratio = -s.ratio;
      double right_depth = 0.0, wrong_depth = 0.0;
      for (const double angle : {0.3, 0.8, 1.3}) {
        const auto depth = [&](const Symmetry& family) {
          return fit_of(part(pair.fixed), part(pair.moving),
                        compose(member(family, &angle), pair.moving_in_fixed), 0.1)
              .depth;
        };
        right_depth = std::max(right_depth, depth(s));
        wrong_depth = std::max(wrong_depth, depth(wrong));
      }
      EXPECT_LT(right_depth, 0.12) << pair.name;
      EXPECT_GT(wrong_depth, 0.25) << pair.name;
    }
  EXPECT_EQ(seen.size(), 2U);
}

}  // namespace
}  // namespace mortise
