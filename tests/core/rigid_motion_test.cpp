// SPDX-License-Identifier: GPL-3.0-or-later
// Rigid motions: composition, inverse, canonical quaternions.
#include "mortise/core/rigid_motion.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace mortise {
namespace {

RigidMotion sample_motion(double a, double b, double c) {
  return {canonical(Eigen::Quaterniond(a, b, c, 0.3)), Eigen::Vector3d(b, -c, a)};
}

TEST(RigidMotion, CompositionAppliesRightFactorFirst) {
  const RigidMotion a = sample_motion(0.2, -0.7, 1.1);
  const RigidMotion b = sample_motion(-0.5, 0.1, 0.4);
  const Eigen::Vector3d x(1.0, 2.0, 3.0);
  EXPECT_LT((compose(a, b) * x - a * (b * x)).norm(), 1e-14);
}

TEST(RigidMotion, InverseUndoes) {
  const RigidMotion m = sample_motion(-0.3, 0.8, 0.2);
  const Eigen::Vector3d x(1.0, 2.0, 3.0);
  EXPECT_LT((inverse(m) * (m * x) - x).norm(), 1e-14);
}

TEST(RigidMotion, CanonicalHasNonNegativeScalarPart) {
  const Eigen::Quaterniond q(-2.0, 1.0, 0.0, 0.5);
  EXPECT_GT(canonical(q).w(), 0.0);
  EXPECT_NEAR(canonical(q).norm(), 1.0, 1e-15);
  EXPECT_NEAR(rotation_angle(canonical(q), q.normalized()), 0.0, 1e-7);
  EXPECT_GT(canonical(Eigen::Quaterniond(0.0, -1.0, 2.0, 0.0)).x(), 0.0);
}

TEST(RigidMotion, RotationAngleIsExactForSmallAndLargeAngles) {
  for (const double angle : {1e-9, 1e-3, 1.0, 3.0, std::numbers::pi}) {
    const Eigen::Quaterniond q(Eigen::AngleAxisd(angle, Eigen::Vector3d(1, 2, -2).normalized()));
    EXPECT_NEAR(rotation_angle(Eigen::Quaterniond::Identity(), q), angle, 1e-15 + 1e-14 * angle);
  }
}

}  // namespace
}  // namespace mortise
