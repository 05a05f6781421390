// SPDX-License-Identifier: GPL-3.0-or-later
// Superposition: worked by hand, against Kabsch's SVD, and where reflections would tempt.
#include "mortise/metrics/superpose.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/paired_moments.hpp"
#include "helpers/random_motions.hpp"
#include "metrics/bodies.hpp"
#include "mortise/core/errors.hpp"
#include "reference/slow_complex_metrics.hpp"

namespace mortise {
namespace {

using tests::random_turn;

reference::Points columns(const Eigen::Matrix3Xd& points) {
  reference::Points out;
  for (Eigen::Index i = 0; i < points.cols(); ++i) out.push_back(points.col(i));
  return out;
}

TEST(Superpose, TwoSticksOfLengthFourAndSixLeaveOne) {
  Eigen::Matrix3Xd a(3, 2);
  Eigen::Matrix3Xd b(3, 2);
  a << 0, 4, 0, 0, 0, 0;
  b << 7, 7, 1, 7, 3, 3;  // along y
  const Superposition s = superpose(a, b);
  EXPECT_NEAR(s.rmsd, 1.0, 1e-14);
  EXPECT_NEAR(rmsd(s.motion * a, b), 1.0, 1e-14);
  EXPECT_NEAR(((s.motion * a).col(1) - Eigen::Vector3d(7, 6, 3)).norm(), 0.0, 1e-14);
}

TEST(Superpose, RefusesToReflect) {
  // A right-handed corner onto its mirror image: the best proper rotation leaves the smallest axis
  // wrong.
  Eigen::Matrix3Xd a(3, 6);
  a << 3, -3, 0, 0, 0, 0, 0, 0, 2, -2, 0, 0, 0, 0, 0, 0, 1, -1;
  Eigen::Matrix3Xd b = a;
  b.row(0) *= -1.0;
  const Superposition s = superpose(a, b);
  EXPECT_NEAR(s.motion.rotation.toRotationMatrix().determinant(), 1.0, 1e-12);
  EXPECT_NEAR(s.rmsd, std::sqrt(2.0 * 4.0 / 6.0),
              1e-12);  // the two points at z = +-1 end up 2 away
}

TEST(Superpose, RecoversAMotionAndAgreesWithTheSvd) {
  std::mt19937 random(7);
  for (const int n : {3, 4, 10, 1000})
    for (const double noise : {0.0, 0.1, 20.0}) {
      const Eigen::Matrix3Xd a = 10.0 * Eigen::Matrix3Xd::Random(3, n);
      const RigidMotion m = random_turn(random, 2.0 + n % 3 * 0.5, 30.0);
      const Eigen::Matrix3Xd b = m * a + noise * Eigen::Matrix3Xd::Random(3, n);
      const Superposition s = superpose(a, b);
      auto from = columns(a);
      const auto [R, t] = reference::kabsch(from, columns(b));
      for (auto& p : from) p = (R * p + t).eval();
      EXPECT_NEAR(s.rmsd, reference::rmsd(from, columns(b)), 1e-12 * (30.0 + noise));
      if (noise == 0.0 && n > 3) {
        EXPECT_NEAR(rotation_angle(s.motion.rotation, m.rotation), 0.0, 1e-12);
        EXPECT_NEAR((s.motion.translation - m.translation).norm(), 0.0, 1e-11);
      }
    }
}

// Two points, points on a line and points in space: moments of rank one and more.
TEST(Superpose, RmsdAndRotationAreThoseOfTheSvdAtAnyScale) {
  std::mt19937 random(8);
  for (const double scale : {1e-4, 1.0, 1e2, 1e6})
    for (int trial = 0; trial < 300; ++trial) {
      Eigen::Matrix3Xd a = scale * Eigen::Matrix3Xd::Random(3, 2 + trial % 3);
      if (trial % 2 == 0) a = (a.col(0) * Eigen::RowVectorXd::Random(a.cols())).eval();
      const Eigen::Matrix3Xd b = (1.0 + 0.1 * (trial % 5)) * (random_turn(random, 3.0, scale) * a);
      auto from = columns(a);
      const auto [R, t] = reference::kabsch(from, columns(b));
      for (auto& p : from) p = (R * p + t).eval();
      const double expected = reference::rmsd(from, columns(b));
      // The moments leave half of the digits to a small difference (core/paired_moments.cpp).
      EXPECT_NEAR(detail::rmsd_superposed(detail::paired_moments(a, b)), expected, 1e-7 * scale);
      EXPECT_NEAR(superpose(a, b).rmsd, expected, 1e-12 * scale);
    }
}

TEST(Superpose, RefusesUnequalEmptyAndNonFiniteSets) {
  const Eigen::Matrix3Xd two = Eigen::Matrix3Xd::Zero(3, 2);
  Eigen::Matrix3Xd bad = two;
  bad(1, 1) = std::nan("");
  EXPECT_THROW((void)superpose(two, Eigen::Matrix3Xd::Zero(3, 3)), InputError);
  EXPECT_THROW((void)superpose(Eigen::Matrix3Xd(3, 0), Eigen::Matrix3Xd(3, 0)), InputError);
  EXPECT_THROW((void)superpose(two, bad), InputError);
  EXPECT_THROW((void)rmsd(bad, two), InputError);
}

}  // namespace
}  // namespace mortise
