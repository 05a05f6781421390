// SPDX-License-Identifier: GPL-3.0-or-later
// The ways of making rotation sets: counts, canonical form, evenness, and how well the stored ones
// cover.
#include "mortise/rotations/rotation_set.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "mortise/core/errors.hpp"
#include "mortise/rotations/coverage.hpp"
#include "mortise/rotations/rotation_index.hpp"
#include "reference/rotations_reference.hpp"
#include "rotations/groups.hpp"

namespace mortise {
namespace {

constexpr double kInDegrees = 180.0 / std::numbers::pi;

// Radius of SO(3)-balls that would fill it without overlap: no covering radius is smaller.
double ball_radius(Eigen::Index count) {
  // Share of SO(3) within angle a: (a - sin a) / pi.
  double low = 0.0, high = std::numbers::pi;
  for (int step = 0; step < 60; ++step) {
    const double a = 0.5 * (low + high);
    ((a - std::sin(a)) * static_cast<double>(count) < std::numbers::pi ? low : high) = a;
  }
  return low;
}

void expect_canonical(const Eigen::Matrix4Xd& quaternions) {
  EXPECT_GE(quaternions.row(0).minCoeff(), 0.0);
  EXPECT_LT((quaternions.colwise().norm().array() - 1.0).abs().maxCoeff(), 1e-14);
}

TEST(RotationSet, HasTheCountAskedForInCanonicalForm) {
  for (const Eigen::Index count : {1, 2, 3, 10, 59, 1000, 3600}) {
    const RotationSet set = rotation_set(count);
    EXPECT_EQ(set.size(), count);
    expect_canonical(set.quaternions);
    EXPECT_NE(set.method, RotationMethod::kAuto);
    EXPECT_EQ(set.rotation(count - 1).w(), set.quaternions(0, count - 1));
    EXPECT_GE(set.covering_radius, ball_radius(count));
  }
}

TEST(RotationSet, SuperFibonacciAndHopfAreEven) {
  for (const Eigen::Index count : {576, 1944}) {
    for (const auto method : {RotationMethod::kSuperFibonacci, RotationMethod::kHopf}) {
      const RotationSet set = rotation_set(count, method);
      ASSERT_EQ(set.size(), count);
      expect_canonical(set.quaternions);
      const Coverage coverage = measure_coverage(set.quaternions);
      EXPECT_EQ(coverage.covering_radius, set.covering_radius);
      EXPECT_LT(set.covering_radius, 1.75 * ball_radius(count)) << rotation_method_name(method);
      EXPECT_GT(coverage.smallest_cell, 0.75);
      EXPECT_LT(coverage.largest_cell, 1.25);
      EXPECT_GT(coverage.separation, 0.85 * ball_radius(count));
    }
  }
}

TEST(RotationSet, SuperFibonacciIsTheSpiralOfThePaper) {
  // Algorithm 1 of the paper by hand for the second of three: s = 1.5, t = 0.5, psi
  // = 1.5337511687552043.
  const double alpha = 2.0 * std::numbers::pi * 1.5 / std::numbers::sqrt2;
  const double beta = 2.0 * std::numbers::pi * 1.5 / 1.5337511687552043;
  const double r = std::sqrt(0.5);
  const Eigen::Quaterniond expected(r * std::cos(beta), r * std::sin(alpha), r * std::cos(alpha),
                                    r * std::sin(beta));
  EXPECT_LT(rotation_angle(expected, reference::column(super_fibonacci_rotations(3), 1)), 1e-12);
}

TEST(RotationSet, HopfHasEachDirectionWithAllTurns) {
  // n = 2: 48 directions, 12 turns each; the turns of one direction are 30 degrees apart about a
  // fixed image of z.
  const Eigen::Matrix4Xd set = hopf_rotations(576);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d moment = Eigen::Matrix3d::Zero();
  for (Eigen::Index first = 0; first < 576; first += 12) {
    const Eigen::Quaterniond a = reference::column(set, first);
    const Eigen::Vector3d axis = a * Eigen::Vector3d::UnitZ();
    for (Eigen::Index k = 1; k < 12; ++k) {
      const Eigen::Quaterniond b = reference::column(set, first + k);
      EXPECT_LT((b * Eigen::Vector3d::UnitZ() - axis).norm(), 1e-12);
      EXPECT_NEAR(rotation_angle(a, b) * kInDegrees,
                  30.0 * static_cast<double>(std::min(k, 12 - k)), 1e-9);
    }
    sum += axis;
    moment += axis * axis.transpose();
  }
  // Equal-area pixels: directions average out and have nearly the moment of the sphere.
  EXPECT_LT(sum.norm(), 1e-12);
  EXPECT_LT((moment / 48.0 - Eigen::Matrix3d::Identity() / 3.0).norm(), 0.02);
}

TEST(RotationSet, StoredSetsAreCosetsAndCoverAsTheirTablesSay) {
  const std::vector<Eigen::Quaterniond> group = rotation_group("I");
  EXPECT_THAT(stored_rotation_counts(), testing::IsSupersetOf({3600, 54000}));
  for (const Eigen::Index count : stored_rotation_counts()) {
    if (count > 8000) continue;  // the next test
    const RotationSet set = rotation_set(count, RotationMethod::kIcosahedral);
    ASSERT_EQ(set.size(), count);
    expect_canonical(set.quaternions);
    EXPECT_NEAR(set.covering_radius, covering_radius(set.quaternions), 1e-8) << count;
    EXPECT_LT(set.covering_radius, covering_radius(super_fibonacci_rotations(count))) << count;
    const RotationIndex index(set.quaternions);
    for (const Eigen::Quaterniond& g : group)
      EXPECT_EQ(index.within(g * set.rotation(count - 1), 1e-6).size(), 1u) << count;
  }
}

TEST(RotationSet, DockingSetOf3600CoversWithin12Degrees6) {
  const RotationSet set = rotation_set(3600);
  EXPECT_EQ(set.method, RotationMethod::kIcosahedral);
  EXPECT_LE(covering_radius(set.quaternions) * kInDegrees, 12.6);
}

TEST(RotationSet, LargeStoredSetsCoverAsTheirTablesSay) {
  for (const Eigen::Index count : stored_rotation_counts()) {
    if (count <= 8000) continue;
    const RotationSet set = rotation_set(count);
    ASSERT_EQ(set.size(), count);
    EXPECT_EQ(set.method, RotationMethod::kIcosahedral);
    expect_canonical(set.quaternions);
    EXPECT_NEAR(set.covering_radius, covering_radius(set.quaternions), 1e-8) << count;
    if (count == 54000) {
      EXPECT_LE(set.covering_radius * kInDegrees, 5.24);
    }
  }
}

TEST(RotationSet, IsTheSameEveryTimeForAnyNumberOfThreads) {
  for (const auto method : {RotationMethod::kAuto, RotationMethod::kSuperFibonacci}) {
    const RotationSet one = rotation_set(3600, method, 1);
    const RotationSet two = rotation_set(3600, method, 2);
    EXPECT_EQ(one.quaternions, two.quaternions);
    EXPECT_EQ(one.covering_radius, two.covering_radius);
  }
}

TEST(RotationSet, RefusesWhatItCannotMake) {
  for (const Eigen::Index count : {Eigen::Index{0}, Eigen::Index{-3}, kMaxRotations + 1}) {
    EXPECT_THROW((void)rotation_set(count), InputError);
    EXPECT_THROW((void)super_fibonacci_rotations(count), InputError);
    EXPECT_THROW((void)hopf_rotations(count), InputError);
  }
  EXPECT_THROW((void)rotation_set(61, RotationMethod::kIcosahedral), InputError);
  try {
    (void)hopf_rotations(577);
    FAIL();
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), testing::HasSubstr("577"));
    EXPECT_THAT(e.what(), testing::HasSubstr("576"));
  }
}

TEST(RotationMethod, NamesGoBothWays) {
  for (const auto method : {RotationMethod::kAuto, RotationMethod::kSuperFibonacci,
                            RotationMethod::kHopf, RotationMethod::kIcosahedral})
    EXPECT_EQ(rotation_method(rotation_method_name(method)), method);
  EXPECT_THROW((void)rotation_method("fibonacci"), InputError);
}

}  // namespace
}  // namespace mortise
