// SPDX-License-Identifier: GPL-3.0-or-later
// The exponential map against its power series, and where it is delicate.
#include "mortise/core/rotation_vector.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "mortise/core/rigid_motion.hpp"

namespace {

using mortise::rotation_from_vector;

TEST(RotationVector, IsThePowerSeriesOfTheCrossProduct) {
  const Eigen::Vector3d direction = Eigen::Vector3d(1, -2, 2) / 3.0;
  for (const double angle : {0.0, 1e-300, 1e-160, 1e-9, 0.1, 1.0, 3.0, 7.0}) {
    const Eigen::Vector3d w = angle * direction;
    Eigen::Matrix3d cross;
    cross << 0, -w[2], w[1], w[2], 0, -w[0], -w[1], w[0], 0;
    Eigen::Matrix3d sum = Eigen::Matrix3d::Identity(), term = sum;
    for (int n = 1; n <= 60; ++n) sum += term = term * cross / n;
    // The largest term, e^7, times the rounding of one.
    EXPECT_LT((rotation_from_vector(w).toRotationMatrix() - sum).norm(), 1e-12) << angle;
    EXPECT_NEAR(rotation_from_vector(w).norm(), 1.0, 1e-15);
  }
}

TEST(RotationVector, AHalfTurnByHand) {
  const Eigen::Quaterniond q = rotation_from_vector({0.0, 0.0, std::numbers::pi});
  EXPECT_LT((q * Eigen::Vector3d(1, 2, 3) - Eigen::Vector3d(-1, -2, 3)).norm(), 1e-15 * 8);
}

TEST(RotationVector, OppositeVectorsAreInverse) {
  const Eigen::Vector3d w(0.3, -1.2, 0.5);
  EXPECT_LT(mortise::rotation_angle(rotation_from_vector(w) * rotation_from_vector(-w),
                                    Eigen::Quaterniond::Identity()),
            1e-7);  // the arc cosine's half of the digits
}

TEST(RotationBetween, TurnsOneDirectionToTheOtherTheShortestWay) {
  const Eigen::Vector3d from(0.3, -1.2, 0.5), across = from.unitOrthogonal();
  for (const double angle : {0.0, 1e-17, 1e-9, 1e-3, 0.5, 1.5, 1.6, 3.0}) {
    for (const double short_of_half : {angle, std::numbers::pi - angle}) {
      const Eigen::Vector3d to =
          7.0 * (std::cos(short_of_half) * from.normalized() + std::sin(short_of_half) * across);
      const Eigen::Quaterniond q = mortise::rotation_between(from, to);
      EXPECT_NEAR(q.norm(), 1.0, 1e-15 * 4);
      EXPECT_LT((q * from.normalized() - to.normalized()).norm(), 1e-15 * 16) << short_of_half;
      // The axis lies across both: nothing is turned about the directions themselves. Within 1e-8
      // of a half turn any axis across will do.
      EXPECT_NEAR(2.0 * std::atan2(q.vec().norm(), std::abs(q.w())), short_of_half, 2e-8);
    }
  }
}

TEST(RotationBetween, OfOppositeDirectionsIsAHalfTurnAcrossThem) {
  for (const Eigen::Vector3d& from :
       {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 0, -1), Eigen::Vector3d(1, -2, 2)}) {
    const Eigen::Quaterniond q = mortise::rotation_between(from, -2.0 * from);
    EXPECT_LT((q * from + from).norm(), 1e-15 * 8 * from.norm());
    EXPECT_NEAR(q.w(), 0.0, 1e-15);
    EXPECT_NEAR(q.vec().dot(from), 0.0, 1e-15 * 4 * from.norm());
  }
}

}  // namespace
