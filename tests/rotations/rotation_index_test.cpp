// SPDX-License-Identifier: GPL-3.0-or-later
// Neighbours of rotations against trying all members.
#include "mortise/rotations/rotation_index.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "helpers/random_motions.hpp"
#include "mortise/core/errors.hpp"
#include "mortise/rotations/rotation_set.hpp"
#include "reference/rotations_reference.hpp"

namespace mortise {
namespace {

TEST(RotationIndex, AgreesWithTryingAllMembers) {
  std::mt19937_64 random(3);
  for (const Eigen::Index count : {1, 2, 7, 100, 1500}) {
    const Eigen::Matrix4Xd set = super_fibonacci_rotations(count);
    const RotationIndex index(set);
    for (int trial = 0; trial < 20; ++trial) {
      Eigen::Quaterniond q = tests::random_rotation(random);
      if (trial % 2 == 1) q.coeffs() = -q.coeffs();
      if (trial == 0) q = reference::column(set, count / 2);
      for (const double angle : {0.0, 0.05, 0.3, 1.0, 2.5, std::numbers::pi}) {
        std::vector<Eigen::Index> expected;
        for (Eigen::Index i = 0; i < count; ++i)
          if (rotation_angle(q, reference::column(set, i)) <= angle) expected.push_back(i);
        // The member itself lies within 0 of itself only up to rounding.
        if (trial == 0 && angle == 0.0) continue;
        EXPECT_EQ(index.within(q, angle), expected) << count << " rotations, angle " << angle;
      }
    }
  }
}

TEST(RotationIndex, FindsAllMembersOfATie) {
  const Eigen::Matrix4Xd twice = super_fibonacci_rotations(10).replicate(1, 2);
  const RotationIndex index(twice);
  const Eigen::Quaterniond q = reference::column(twice, 4);
  EXPECT_EQ(index.within(q, 1e-6), (std::vector<Eigen::Index>{4, 14}));
}

TEST(RotationIndex, RefusesBadQuestions) {
  EXPECT_THROW(RotationIndex(Eigen::Matrix4Xd(4, 0)), InputError);
  EXPECT_THROW(RotationIndex(Eigen::Matrix4Xd::Constant(4, 2, 0.7)), InputError);
  const RotationIndex index(super_fibonacci_rotations(10));
  const Eigen::Quaterniond q = Eigen::Quaterniond::Identity();
  EXPECT_THROW((void)index.within(q, -0.1), InputError);
  EXPECT_THROW((void)index.within(q, std::numeric_limits<double>::quiet_NaN()), InputError);
  EXPECT_THROW((void)index.within(Eigen::Quaterniond(2.0, 0.0, 0.0, 0.0), 0.1), InputError);
}

}  // namespace
}  // namespace mortise
