// SPDX-License-Identifier: GPL-3.0-or-later
// Distance of two poses: by hand, and against the sum over all points.
#include "mortise/core/pose_distance.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "helpers/random_motions.hpp"
#include "metrics/bodies.hpp"
#include "mortise/core/errors.hpp"
#include "mortise/metrics/superpose.hpp"

namespace mortise {
namespace {

using tests::random_turn;

TEST(PoseDistance, HalfTurnOfAStickByHand) {
  // Points at x = 1 and x = 3; half a turn about z carries them to -1 and -3: distances 2 and 6.
  Eigen::Matrix3Xd points(3, 2);
  points << 1, 3, 0, 0, 0, 0;
  const PoseDistance distance(points);
  const RigidMotion turn{
      Eigen::Quaterniond(Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d::UnitZ())),
      Eigen::Vector3d::Zero()};
  EXPECT_NEAR(distance.rmsd({}, turn), std::sqrt((4.0 + 36.0) / 2.0), 1e-14);
  EXPECT_NEAR(distance.rmsd({}, {Eigen::Quaterniond::Identity(), {0, 3, 4}}), 5.0, 1e-14);
}

TEST(PoseDistance, EqualsTheDirectSumOverSizesAndAngles) {
  std::mt19937 random(3);
  for (const int n : {1, 2, 3, 50, 2000}) {
    const Eigen::Matrix3Xd points =
        (20.0 * Eigen::Matrix3Xd::Random(3, n)).colwise() + Eigen::Vector3d(50, -80, 10);
    const PoseDistance distance(points);
    for (const double angle : {0.0, 1e-6, 0.01, 0.3, 2.0, 3.1}) {
      const RigidMotion a = random_turn(random, 1.7, 40.0);
      // b: a step from a about the body's own centroid, so that small angles make small distances
      const RigidMotion about{Eigen::Quaterniond::Identity(), distance.centroid()};
      const RigidMotion b =
          compose(a, compose(about, compose(random_turn(random, angle, angle), inverse(about))));
      const double direct = rmsd(a * points, b * points);
      // The points lie 100 from the origin: both sides carry rounding of about 1e-14 x 100.
      EXPECT_NEAR(distance.rmsd(a, b), direct, 1e-12 * direct + 2e-13) << n << ' ' << angle;
      EXPECT_NEAR(distance.rmsd(b, a), direct, 1e-12 * direct + 2e-13);
    }
  }
}

TEST(PoseDistance, RefusesNoPointsAndNonFiniteOnes) {
  EXPECT_THROW(PoseDistance(Eigen::Matrix3Xd(3, 0)), InputError);
  EXPECT_THROW(PoseDistance(Eigen::Matrix3Xd::Constant(3, 2, std::nan(""))), InputError);
}

}  // namespace
}  // namespace mortise
