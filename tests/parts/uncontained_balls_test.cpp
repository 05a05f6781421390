// SPDX-License-Identifier: GPL-3.0-or-later
// Dropping balls inside others against the rule written out.
#include "mortise/parts/uncontained_balls.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "mortise/core/errors.hpp"

namespace mortise {
namespace {

// Largest first, each against all kept before.
std::vector<Eigen::Index> by_looking_at_all(const Eigen::Matrix4Xd& balls, double growth) {
  std::vector<Eigen::Index> order(static_cast<std::size_t>(balls.cols())), kept;
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](Eigen::Index a, Eigen::Index b) { return balls(3, a) > balls(3, b); });
  for (const Eigen::Index i : order) {
    const bool contained = std::any_of(kept.begin(), kept.end(), [&](Eigen::Index k) {
      const double reach = balls(3, k) + growth - balls(3, i);
      return (balls.col(k) - balls.col(i)).head<3>().squaredNorm() <= reach * reach;
    });
    if (!contained) kept.push_back(i);
  }
  return kept;
}

TEST(UncontainedBalls, AreThoseOfTheRule) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(-1.0, 1.0), power(-6.0, 0.0);
  for (const int count : {1, 2, 50, 600}) {
    Eigen::Matrix4Xd balls(4, count);
    for (int i = 0; i < count; ++i)  // radii over six octaves and some of zero
      balls.col(i) << place(random), place(random), place(random),
          i % 17 == 16 ? 0.0 : std::exp2(power(random));
    if (count > 10) balls.col(3) = balls.col(7);
    for (const double growth : {0.0, 0.01, 0.1, 1.0}) {
      const std::vector<Eigen::Index> kept = uncontained_balls(balls, growth);
      EXPECT_EQ(kept, by_looking_at_all(balls, growth)) << count << " balls, growth " << growth;
      if (growth == 1.0 && count > 10) {
        EXPECT_LT(kept.size(), balls.cols() / 2U);
      }
    }
  }
}

TEST(UncontainedBalls, TwoThatHoldEachOtherLeaveOne) {
  Eigen::Matrix4Xd balls(4, 2);
  balls.col(0) << 0, 0, 0, 1.0;
  balls.col(1) << 0.1, 0, 0, 1.0;
  // The rule of the paper as printed drops both.
  EXPECT_EQ(uncontained_balls(balls, 0.2), std::vector<Eigen::Index>({0}));
  EXPECT_EQ(uncontained_balls(balls, 0.05), std::vector<Eigen::Index>({0, 1}));
}

TEST(UncontainedBalls, RefusesWhatIsNoBall) {
  Eigen::Matrix4Xd balls = Eigen::Matrix4Xd::Ones(4, 3);
  EXPECT_THROW((void)uncontained_balls(balls, -1.0), InputError);
  balls(3, 1) = -1.0;
  EXPECT_THROW((void)uncontained_balls(balls), InputError);
  EXPECT_TRUE(uncontained_balls(Eigen::Matrix4Xd(4, 0)).empty());
}

}  // namespace
}  // namespace mortise
