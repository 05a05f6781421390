// SPDX-License-Identifier: GPL-3.0-or-later
// The exponential map against its power series, and where it is delicate.
#include "mortise/core/rotation_vector.hpp"

#include <gtest/gtest.h>

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

}  // namespace
