// SPDX-License-Identifier: GPL-3.0-or-later
// Contact area, penetration and the way out: by hand on a mortise and its tenon, and on balls.
#include "mortise/metrics/contact.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "helpers/random_motions.hpp"
#include "metrics/bodies.hpp"
#include "mortise/core/errors.hpp"
#include "mortise/kernels/ball.hpp"
#include "runs/voxel_parts.hpp"

namespace mortise {
namespace {

using testing_parts::mortise_block;
using testing_parts::tenon_plate;
using tests::random_turn;

class Ball : public Solid {
 public:
  explicit Ball(double r) : r_(r) {}
  [[nodiscard]] Eigen::AlignedBox3d bounds() const override {
    return {Eigen::Vector3d::Constant(-r_), Eigen::Vector3d::Constant(r_)};
  }
  [[nodiscard]] Eigen::VectorXd signed_distance(const Eigen::Matrix3Xd& points,
                                                double) const override {
    return points.colwise().norm().array() - r_;
  }

 private:
  double r_;
};

TEST(PenetrationVolume, OfTwoBallsIsTheirLens) {
  std::mt19937 random(2);
  for (const double d : {0.0, 0.4, 1.0, 1.5, 1.7, 1.78}) {
    RigidMotion motion = random_turn(random, 2.0, 0.0);
    motion.translation = d * Eigen::Vector3d(1, 2, -2) / 3.0;
    const double lens = ball_overlap_volume(1.0, 0.8, d);
    for (const double cell : {0.1, 0.05}) {
      // The leaves' planes err by curvature, cell^2 / (8 r), on both faces of the lens.
      const double tolerance = cell * cell / 4.0 * 2.0 * 3.0 * lens / (1.8 - d) + 1e-6;
      EXPECT_NEAR(penetration_volume(Ball(1.0), Ball(0.8), motion, cell), lens, tolerance)
          << d << ' ' << cell;
    }
  }
  RigidMotion apart;
  apart.translation << 1.9, 0, 0;
  EXPECT_EQ(penetration_volume(Ball(1.0), Ball(0.8), apart, 0.1), 0.0);
  apart.translation << 30, 0, 0;
  EXPECT_EQ(penetration_volume(Ball(1.0), Ball(0.8), apart, 0.1), 0.0);
  EXPECT_THROW((void)penetration_volume(Ball(1.0), Ball(0.8), apart, 0.0), InputError);
}

TEST(PenetrationVolume, OfThinOverlapsIsNotLostBetweenCells) {
  const Part block = mortise_block();
  const Part plate = tenon_plate();
  for (const double depth : {0.01, 0.2}) {
    RigidMotion down;
    down.translation << 0, 0, -depth;
    // The tenon's tip (2 x 3) and the plate's underside around it (36 - 6) sink in.
    EXPECT_NEAR(penetration_volume(*block.solid, *plate.solid, down, 0.11), 36.0 * depth,
                0.05 * 36.0 * depth);  // the corners' leaves err
    RigidMotion aside;
    aside.translation << depth, 0, 0;
    EXPECT_NEAR(penetration_volume(*block.solid, *plate.solid, aside, 0.11), 9.0 * depth,
                0.05 * 9.0 * depth);
  }
}

TEST(Contact, OfATenonInItsMortiseByHand) {
  std::mt19937 random(4);
  for (int i = 0; i < 2; ++i) {
    const RigidMotion fixed_frame = i == 0 ? RigidMotion{} : random_turn(random, 2.0, 5.0);
    const RigidMotion moving_frame = i == 0 ? RigidMotion{} : random_turn(random, 2.0, 5.0);
    const Part block = mortise_block(fixed_frame);
    const Part plate = tenon_plate(moving_frame);
    const auto measure = [&](const Eigen::Vector3d& shift) {
      const RigidMotion shifted{Eigen::Quaterniond::Identity(), shift};
      return measure_contact(block.mesh, *block.solid, plate.mesh, *plate.solid,
                             compose(fixed_frame, compose(shifted, inverse(moving_frame))),
                             {.resolution = 0.03, .samples = 2000});
    };
    const ContactReport seated = measure({0, 0, 0});
    // Four walls of the hole, 2 (2 + 3) x 3, its floor, 6, and the underside, 36 - 6.
    EXPECT_NEAR(seated.contact_area, 66.0, 0.02 * 66.0);
    EXPECT_LT(seated.penetration_depth, 1e-9);
    EXPECT_LT(seated.penetration_volume,
              0.05 * 0.03 * 66.0);  // a twentieth of a leaf along the contact
    const Eigen::Vector3d up = fixed_frame.rotation * Eigen::Vector3d::UnitZ();
    EXPECT_GT(seated.pull_direction.dot(up), 0.9999);
    EXPECT_EQ(seated.pull_blocked, 0.0);
    const ContactReport raised = measure({0, 0, 0.5});
    EXPECT_NEAR(raised.contact_area, 25.0, 0.03 * 25.0);  // the walls along 2.5
    EXPECT_LT(raised.penetration_depth, 1e-9);
    const ContactReport sunk = measure({0, 0, -0.2});
    EXPECT_NEAR(sunk.penetration_depth, 0.2, 1e-6);
    EXPECT_NEAR(sunk.penetration_volume, 7.2, 0.05 * 7.2);
    const ContactReport away = measure({0, 0, 20});
    EXPECT_EQ(away.contact_area, 0.0);
    EXPECT_EQ(away.pull_direction, Eigen::Vector3d::Zero());
  }
}

TEST(Contact, OfPartsThatHoldEachOtherIsBlocked) {
  // A bar through a closed tunnel whose ends are walled up: no way out.
  const Part box = testing_parts::voxel_part(
      5, [](int i, int j, int k) { return !(i == 2 && j == 2 && k >= 1 && k < 4); });
  const Part bar = testing_parts::voxel_part(
      5, [](int i, int j, int k) { return i == 2 && j == 2 && k >= 1 && k < 4; });
  const ContactReport report = measure_contact(box.mesh, *box.solid, bar.mesh, *bar.solid, {});
  EXPECT_NEAR(report.contact_area, 14.0, 0.3);
  EXPECT_GT(report.pull_blocked, 0.05);
}

}  // namespace
}  // namespace mortise
