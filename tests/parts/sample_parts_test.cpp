// SPDX-License-Identifier: GPL-3.0-or-later
// The sample pairs: closed files, and at every recorded pose contact without penetration.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>
#include <set>

#include "mortise/core/rigid_motion.hpp"
#include "mortise/parts/mesh_solid.hpp"
#include "mortise/parts/read_part.hpp"

namespace mortise {
namespace {

using Eigen::Vector3d;
using nlohmann::json;
using std::numbers::pi;

const std::string kFolder = MORTISE_SOURCE_DIR "/parts/";

json pairs() {
  std::ifstream file(kFolder + "mates.json");
  return json::parse(file).at("pairs");
}

Vector3d vector_of(const json& j) {
  return {j.at(0).get<double>(), j.at(1).get<double>(), j.at(2).get<double>()};
}

RigidMotion turn_about(const Vector3d& point, const Vector3d& direction, double angle) {
  RigidMotion m;
  m.rotation = Eigen::AngleAxisd(angle, direction.normalized());
  m.translation = point - m.rotation * point;
  return m;
}

/// The member of a family at `u` in [0, 1]; u = 0 and 1 are the ends of a range.
RigidMotion member(const json& s, double u) {
  const std::string kind = s.at("kind");
  const Vector3d point = s.contains("point") ? vector_of(s["point"]) : Vector3d::Zero();
  const Vector3d direction =
      s.contains("direction") ? vector_of(s["direction"]) : Vector3d(0.6, 0.0, 0.8);
  if (kind == "turn" || kind == "ball") return turn_about(point, direction, 2 * pi * u);
  if (kind == "fold") {
    const int order = s.at("order");
    return turn_about(point, direction, 2 * pi * std::round(u * order) / order);
  }
  if (kind == "roll") {
    const double angle = 2 * pi * u;
    return compose(turn_about(point, direction, angle),
                   turn_about(vector_of(s["moving_point"]), vector_of(s["moving_direction"]),
                              angle * s["ratio"].get<double>()));
  }
  const double a = s["from"].get<double>() + u * (s["to"].get<double>() - s["from"].get<double>());
  if (kind == "slide") {
    RigidMotion m;
    m.translation = a * direction;
    return m;
  }
  EXPECT_EQ(kind, "screw");
  RigidMotion m = turn_about(point, direction, a);
  m.translation += s["pitch"].get<double>() * a / (2 * pi) * direction;
  return m;
}

RigidMotion pose_of(const json& pair) {
  const auto& q = pair.at("pose").at("rotation");
  RigidMotion m;
  m.rotation = Eigen::Quaterniond(q.at(0).get<double>(), q.at(1).get<double>(),
                                  q.at(2).get<double>(), q.at(3).get<double>());
  m.translation = vector_of(pair["pose"].at("translation"));
  return m;
}

/// Points spread over the surface at random, each standing for the same area.
Eigen::Matrix3Xd points_on(const TriangleMesh& mesh, int count) {
  std::vector<double> upto;
  double area = 0.0;
  for (const auto t : mesh.triangles.colwise()) {
    const Vector3d a = mesh.vertices.col(t(0));
    const Vector3d b = mesh.vertices.col(t(1)) - a;
    const Vector3d c = mesh.vertices.col(t(2)) - a;
    upto.push_back(area += 0.5 * b.cross(c).norm());
  }
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform;
  Eigen::Matrix3Xd points(3, count);
  for (int i = 0; i < count; ++i) {
    const auto t =
        std::lower_bound(upto.begin(), upto.end(), area * uniform(random)) - upto.begin();
    const Eigen::Vector3i corners = mesh.triangles.col(std::min<Eigen::Index>(t, mesh.size() - 1));
    double u = uniform(random);
    double v = uniform(random);
    if (u + v > 1) {
      u = 1 - u;
      v = 1 - v;
    }
    points.col(i) = (1 - u - v) * mesh.vertices.col(corners(0)) +
                    u * mesh.vertices.col(corners(1)) + v * mesh.vertices.col(corners(2));
  }
  return points;
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
  Eigen::Matrix3Xd points = points_on(file.mesh, 3000);
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
RigidMotion any_member(const json& symmetries, int sample) {
  RigidMotion m;
  int n = 0;
  for (const json& s : symmetries) {
    static constexpr double kPlaces[] = {0.0, 1.0, 0.37, 0.72};
    m = compose(m, member(s, kPlaces[static_cast<std::size_t>((sample + n++) % 4)]));
  }
  return m;
}

TEST(SampleParts, EveryFileIsClosedAndTheStepFileIsTheSameSolid) {
  std::set<std::string> stems;
  for (const json& pair : pairs()) {
    stems.insert(pair.at("fixed").get<std::string>());
    stems.insert(pair.at("moving").get<std::string>());
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
  const json all = pairs();
  std::set<std::string> families;
  for (const json& pair : all) {
    const std::string name = pair.at("name");
    families.insert(name.substr(0, name.rfind('_')));
    const Part& fixed = part(pair.at("fixed"));
    const Part& moving = part(pair.at("moving"));
    // Both are tessellated to 0.06 mm or better, and clearance opens gaps of up to 0.25 mm.
    const double touch = 0.15 + 0.1 * (pair.at("clearance").get<double>() / 0.02);
    const int samples = pair.at("symmetries").empty() ? 1 : 5;
    for (int i = 0; i < samples; ++i) {
      const RigidMotion pose =
          i == 0 ? pose_of(pair) : compose(any_member(pair["symmetries"], i), pose_of(pair));
      const Fit fit = fit_of(fixed, moving, pose, touch);
      EXPECT_LT(fit.depth, name.starts_with("thread") ? 0.12 : 0.04) << name << " member " << i;
      // A gear touches along one line per tooth pair; everything else over a good part of it.
      EXPECT_GT(fit.contact, name.starts_with("spur") ? 0.007 : 0.08) << name << " member " << i;
    }
    // The check would notice: a shift by 2% of the diameter, along whichever axis is worst.
    double worst = 0.0;
    for (int axis = 0; axis < 6; ++axis) {
      RigidMotion shifted = pose_of(pair);
      shifted.translation(axis / 2) += (axis % 2 == 0 ? 0.02 : -0.02) * moving.diameter;
      worst = std::max(worst, fit_of(fixed, moving, shifted, touch).depth);
    }
    EXPECT_GT(worst, 0.2) << name;
  }
  EXPECT_GE(all.size(), 30U);
  EXPECT_GE(families.size(), 16U);
}

}  // namespace
}  // namespace mortise
