// SPDX-License-Identifier: GPL-3.0-or-later
// Energy, force and torque of analytic parts, letting go, and hand motions.
#include "mortise/assembly/assembly_session.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "collision/bodies.hpp"
#include "mortise/assembly/hand_path.hpp"
#include "mortise/assembly/mortise_wrench.h"
#include "mortise/assembly/part_field.hpp"
#include "mortise/core/errors.hpp"
#include "parts/shapes.hpp"

namespace mortise {
namespace {

using tests::nudged;

// A box by its half sides; `hollow`: a block of twice that with the box cut out of its top.
class BoxSolid : public Solid {
 public:
  BoxSolid(const Eigen::Vector3d& half, bool hollow) : half_(half), hollow_(hollow) {}
  [[nodiscard]] Eigen::AlignedBox3d bounds() const override {
    const Eigen::Vector3d b = hollow_ ? 2.0 * half_ : half_;
    return {-b, b};
  }
  [[nodiscard]] Eigen::VectorXd signed_distance(const Eigen::Matrix3Xd& points,
                                                double) const override {
    Eigen::VectorXd result(points.cols());
    for (Eigen::Index i = 0; i < points.cols(); ++i) {
      const Eigen::Vector3d p = points.col(i);
      if (!hollow_) {
        result[i] = box(p, Eigen::Vector3d::Zero(), half_);
        continue;
      }
      // The hole runs from the middle up through the top.
      const Eigen::Vector3d centre(0.0, 0.0, 2.0 * half_[2]);
      const Eigen::Vector3d sides(half_[0], half_[1], 2.0 * half_[2]);
      result[i] = std::max(box(p, Eigen::Vector3d::Zero(), 2.0 * half_), -box(p, centre, sides));
    }
    return result;
  }

 private:
  static double box(const Eigen::Vector3d& p, const Eigen::Vector3d& centre,
                    const Eigen::Vector3d& half) {
    const Eigen::Vector3d q = (p - centre).cwiseAbs() - half;
    return q.cwiseMax(0.0).norm() + std::min(q.maxCoeff(), 0.0);
  }
  Eigen::Vector3d half_;
  bool hollow_;
};

struct PegInHole {
  BoxSolid block{{1.0, 0.8, 1.0}, true}, peg{{1.0, 0.8, 1.0}, false};
  AssemblySession session;
  RigidMotion mate;  // the peg's bottom on the hole's: centre one above the block's
  explicit PegInHole(int modes = 4096, int grid = 48)
      : session(double_skin_field(block, {.grid = grid, .thickness = 0.3}),
                double_skin_field(peg, {.grid = grid / 2, .thickness = 0.3}), {.modes = modes}) {
    mate.translation = {0.0, 0.0, 1.0};
  }
};

TEST(AssemblySession, TheMateHasTheLeastEnergy) {
  const PegInHole parts;
  const double mated = parts.session.wrench(parts.mate).energy;
  EXPECT_LT(mated, 0.0);
  const RigidMotion apart{Eigen::Quaterniond::Identity(), {0.0, 0.0, 3.5}},
      beside{Eigen::Quaterniond::Identity(), {3.1, 0.0, 0.0}},
      inside{Eigen::Quaterniond::Identity(), {0.5, 0.0, 0.5}};
  EXPECT_LT(mated, 3.0 * parts.session.wrench(beside).energy);  // one face's fit, against five
  EXPECT_LT(std::abs(parts.session.wrench(apart).energy), 0.1 * std::abs(mated));
  EXPECT_GT(parts.session.wrench(inside).energy, 0.5 * std::abs(mated));  // overlap costs
}

TEST(AssemblySession, ForceAndTorqueAreTheEnergysSlopes) {
  const PegInHole parts(2000, 32);
  std::mt19937_64 random(4);
  double error = 0.0, scale = 0.0;
  for (int i = 0; i < 8; ++i) {
    const RigidMotion pose = tests::random_pose({0, 0, 0}, {0, 0, 0}, 2.0, random);
    const Wrench here = parts.session.wrench(pose);
    for (int d = 0; d < 3; ++d) {
      // Single precision and an interpolant whose pieces meet with a small step: hence this step.
      const double h = 0.01;
      const Eigen::Vector3d axis = Eigen::Vector3d::Unit(d), none = Eigen::Vector3d::Zero();
      const double force = (parts.session.wrench(nudged(pose, -h * axis, none)).energy -
                            parts.session.wrench(nudged(pose, h * axis, none)).energy) /
                           (2.0 * h);
      const double torque = (parts.session.wrench(nudged(pose, none, -h * axis)).energy -
                             parts.session.wrench(nudged(pose, none, h * axis)).energy) /
                            (2.0 * h);
      error = std::max({error, std::abs(force - here.force[d]), std::abs(torque - here.torque[d])});
      scale = std::max({scale, std::abs(force), std::abs(torque)});
    }
  }
  EXPECT_LT(error, 0.02 * scale);
}

TEST(AssemblySession, APartLetGoNearTheMateSnapsIn) {
  const PegInHole parts;
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  int home = 0;
  constexpr int kStarts = 10;
  for (int i = 0; i < kStarts; ++i) {
    const Eigen::Vector3d shift(0.1 * uniform(random), 0.1 * uniform(random),
                                0.15 * (1.0 + uniform(random)));
    const Eigen::Vector3d turn(0.1 * uniform(random), 0.1 * uniform(random), 0.1 * uniform(random));
    const Rest rest = follow(parts.session, nudged(parts.mate, shift, turn));
    EXPECT_LE(rest.wrench.energy, parts.session.wrench(nudged(parts.mate, shift, turn)).energy);
    home += (rest.pose.translation - parts.mate.translation).norm() < 0.1 &&
                    rotation_angle(rest.pose.rotation, parts.mate.rotation) < 0.1
                ? 1
                : 0;
  }
  EXPECT_GE(home, 9);
}

TEST(HandPath, EndsAtTheGoalWithoutJumpsAndIsDeterministic) {
  RigidMotion goal{Eigen::Quaterniond(Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitY())), {1, 2, 3}};
  goal.rotation = canonical(goal.rotation);
  const Eigen::Vector3d centre(0.2, -0.3, 0.1);
  const HandPathOptions options{.seconds = 4.0, .tremor = 0.0};
  const std::vector<RigidMotion> path = hand_path(goal, centre, 2.0, options);
  ASSERT_EQ(path.size(), 4000U);
  EXPECT_LT((path.back().translation - goal.translation).norm(), 1e-3);
  double farthest = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    EXPECT_LT((path[i] * centre - path[i - 1] * centre).norm(), 0.05);
    farthest = std::max(farthest, (path[i] * centre - goal * centre).norm());
  }
  EXPECT_NEAR(farthest, 2.0, 0.05);
  const std::vector<RigidMotion> shaking = hand_path(goal, centre, 2.0, {.seconds = 4.0});
  const std::vector<RigidMotion> again = hand_path(goal, centre, 2.0, {.seconds = 4.0});
  double sum = 0.0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    sum += (shaking[i] * centre - path[i] * centre).squaredNorm();
    EXPECT_EQ(shaking[i].translation, again[i].translation);
  }
  EXPECT_NEAR(std::sqrt(sum / 4000.0), 0.004, 0.0015);  // the tremor asked for: 0.002 of radius 2
}

// A cube's triangles for the C interface.
struct CCube {
  TriangleMesh mesh = shapes::cube(1.0);
  [[nodiscard]] mortise_mesh view() const {
    return {mesh.vertices.data(), static_cast<long>(mesh.vertices.cols()), mesh.triangles.data(),
            static_cast<long>(mesh.size())};
  }
};

TEST(CInterface, RefusesOpenAndInsideOutMeshesAndBadThickness) {
  const CCube good, open{shapes::without_last(good.mesh, 1)}, inward{shapes::inside_out(good.mesh)};
  mortise_session_options options = {};
  options.grid = 16;
  options.modes = 200;
  const auto create = [&](const CCube& fixed, const CCube& moving) {
    const mortise_mesh a = fixed.view(), b = moving.view();
    mortise_session* session = nullptr;
    const int code = mortise_session_create(&a, &b, &options, &session);
    EXPECT_EQ(code == 0, session != nullptr);
    mortise_session_free(session);
    return code;
  };
  EXPECT_EQ(create(good, good), 0);
  EXPECT_EQ(create(good, open), 1);
  EXPECT_THAT(mortise_last_error(), ::testing::HasSubstr("moving mesh is open"));
  EXPECT_EQ(create(inward, good), 1);
  EXPECT_THAT(mortise_last_error(), ::testing::HasSubstr("fixed mesh has the volume -1"));
  for (const double thickness : {-1.0, std::nan("")}) {
    options.thickness = thickness;
    EXPECT_EQ(create(good, good), 1);
    EXPECT_THAT(mortise_last_error(), ::testing::HasSubstr("thickness"));
  }
}

TEST(AssemblySession, RefusesBadInput) {
  const BoxSolid box({1, 1, 1}, false);
  EXPECT_THROW((void)double_skin_field(box, {.grid = 4}), InputError);
  EXPECT_THROW((void)double_skin_field(box, {.penalty = 0.0}), InputError);
  EXPECT_THROW((void)hand_path({}, {0, 0, 0}, 0.0), InputError);
  const PegInHole parts(200, 24);
  EXPECT_THROW((void)follow(parts.session, {}, {.step = 0.0}), InputError);
  EXPECT_THROW((void)hand_path({}, {0, 0, 0}, 1.0, {.seconds = 1e15}), InputError);
  RigidMotion bad;
  bad.translation[0] = std::nan("");
  EXPECT_THROW((void)parts.session.wrench(bad), InputError);
  EXPECT_THROW((void)parts.session.wrench({Eigen::Quaterniond(0, 30, 0, 0), {0, 0, 0}}),
               InputError);
}

}  // namespace
}  // namespace mortise
