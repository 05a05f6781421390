// SPDX-License-Identifier: GPL-3.0-or-later
// Covering radius and means: groups known in closed form, every-four-points reference, random
// rotations.
#include "mortise/rotations/coverage.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "helpers/random_motions.hpp"
#include "mortise/core/errors.hpp"
#include "mortise/rotations/rotation_set.hpp"
#include "reference/rotations_reference.hpp"
#include "rotations/groups.hpp"

namespace mortise {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kDegrees = 180.0 / kPi;

Eigen::Matrix4Xd group_quaternions(const std::string& name) {
  const std::vector<Eigen::Quaterniond> group = rotation_group(name);
  Eigen::Matrix4Xd quaternions(4, static_cast<Eigen::Index>(group.size()));
  for (Eigen::Index i = 0; i < quaternions.cols(); ++i)
    quaternions.col(i) << group[i].w(), group[i].x(), group[i].y(), group[i].z();
  return quaternions;
}

TEST(Coverage, OneRotationReachesAllByPi) {
  const Eigen::Matrix4Xd one = Eigen::Vector4d(0.5, -0.5, 0.5, 0.5);
  const Coverage coverage = measure_coverage(one);
  EXPECT_EQ(coverage.covering_radius, kPi);
  // The angle of a random rotation has the density (1 - cos a) / pi: mean pi / 2 + 2 / pi.
  EXPECT_NEAR(coverage.mean_distance, kPi / 2.0 + 2.0 / kPi, 3e-6);
  EXPECT_EQ(coverage.separation, kPi);
}

TEST(Coverage, GroupsMeetTheirPolytopes) {
  // The farthest rotations sit over the cells of a regular polytope of unit quaternions, or, for O,
  // over the corners (t, t, 1 - 2 t), t = sqrt 2 - 1, of the identity's truncated cube.
  const double t = std::numbers::sqrt2 - 1.0;
  const double edge =
      2.0 *
      std::sin(kPi / 10.0);  // 600-cell; a tetrahedron's corners are sqrt(3/8) edge from its centre
  const double expected_i = 2.0 * std::asin(std::sqrt(0.375) * edge);
  const double expected_o =
      2.0 * std::atan(std::sqrt(2.0 * t * t + (1.0 - 2.0 * t) * (1.0 - 2.0 * t)));
  EXPECT_NEAR(expected_i * kDegrees, 44.4775, 1e-4);
  EXPECT_NEAR(expected_o * kDegrees, 62.7994, 1e-4);
  const struct {
    const char* name;
    Eigen::Index order;
    double covering, separation;
  } cases[] = {{"T", 12, kPi / 2.0, 2.0 * kPi / 3.0},
               {"O", 24, expected_o, kPi / 2.0},
               {"I", 60, expected_i, 2.0 * kPi / 5.0},
               {"D2", 4, 2.0 * kPi / 3.0, kPi}};
  for (const auto& c : cases) {
    const Eigen::Matrix4Xd group = group_quaternions(c.name);
    ASSERT_EQ(group.cols(), c.order) << c.name;
    const Coverage coverage = measure_coverage(group);
    EXPECT_NEAR(coverage.covering_radius, c.covering, 1e-9) << c.name;
    EXPECT_EQ(covering_radius(group), coverage.covering_radius) << c.name;
    EXPECT_NEAR(coverage.separation, c.separation, 1e-9) << c.name;
    EXPECT_NEAR(coverage.smallest_cell, 1.0, 1e-6) << c.name;
    EXPECT_NEAR(coverage.largest_cell, 1.0, 1e-6) << c.name;
  }
}

TEST(Coverage, AgreesWithEveryFourPoints) {
  for (const Eigen::Index count : {4, 5, 7, 10, 16})
    for (unsigned seed = 1; seed <= 3; ++seed) {
      std::mt19937_64 random(seed);
      const Eigen::Matrix4Xd set = tests::random_rotations(random, count);
      EXPECT_NEAR(covering_radius(set), reference::covering_radius(set), 1e-7)
          << count << " rotations, seed " << seed;
    }
}

TEST(Coverage, FarthestRotationIsThatFarAndNoneIsFarther) {
  const Eigen::Matrix4Xd set = super_fibonacci_rotations(300);
  const Coverage coverage = measure_coverage(set);
  const Eigen::Quaterniond farthest(coverage.farthest(0), coverage.farthest(1),
                                    coverage.farthest(2), coverage.farthest(3));
  EXPECT_NEAR(reference::distance(set, farthest), coverage.covering_radius, 1e-9);
  std::mt19937_64 random(5);
  double sum = 0.0, sum_sq = 0.0, most = 0.0;
  constexpr int kSamples = 20'000;
  for (int i = 0; i < kSamples; ++i) {
    const double angle = reference::distance(set, tests::random_rotation(random));
    most = std::max(most, angle);
    sum += angle;
    sum_sq += angle * angle;
  }
  EXPECT_LE(most, coverage.covering_radius);
  EXPECT_GT(most, 0.85 * coverage.covering_radius);
  const double mean = sum / kSamples;
  const double error = std::sqrt((sum_sq / kSamples - mean * mean) / kSamples);
  EXPECT_NEAR(mean, coverage.mean_distance, 4.0 * error);
  EXPECT_LT(coverage.volume_error, 5e-5);
}

TEST(Coverage, TurningTheSetChangesNothing) {
  const Eigen::Matrix4Xd set = super_fibonacci_rotations(200);
  const Eigen::Quaterniond turn = canonical(Eigen::Quaterniond(0.3, -0.8, 0.4, 0.2));
  Eigen::Matrix4Xd turned(4, set.cols());
  for (Eigen::Index i = 0; i < set.cols(); ++i) {
    const Eigen::Quaterniond q = turn * reference::column(set, i);  // not canonical: either sign
    turned.col(i) << q.w(), q.x(), q.y(), q.z();
  }
  const Coverage before = measure_coverage(set);
  const Coverage after = measure_coverage(turned);
  EXPECT_NEAR(before.covering_radius, after.covering_radius, 1e-9);
  EXPECT_NEAR(before.separation, after.separation, 1e-9);
  EXPECT_NEAR(before.mean_distance, after.mean_distance, 1e-5);  // quadrature: frames differ
}

TEST(Coverage, SameBytesForAnyNumberOfThreads) {
  const Eigen::Matrix4Xd set = super_fibonacci_rotations(700);
  const Coverage one = measure_coverage(set, 1);
  const Coverage three = measure_coverage(set, 3);
  EXPECT_EQ(one.covering_radius, three.covering_radius);
  EXPECT_EQ(one.mean_distance, three.mean_distance);
  EXPECT_EQ(one.farthest, three.farthest);
  EXPECT_EQ(one.largest_cell, three.largest_cell);
}

TEST(Coverage, RefusesWhatIsNoSet) {
  EXPECT_THROW((void)covering_radius(Eigen::Matrix4Xd(4, 0)), InputError);
  Eigen::Matrix4Xd set = super_fibonacci_rotations(5);
  set.col(3) *= 1.1;
  EXPECT_THROW((void)measure_coverage(set), InputError);
  set(0, 3) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((void)covering_radius(set), InputError);
}

}  // namespace
}  // namespace mortise
