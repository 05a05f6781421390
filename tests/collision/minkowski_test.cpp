// SPDX-License-Identifier: GPL-3.0-or-later
// Sums and obstacles of balls against brute force over pairs and points.
#include "mortise/collision/minkowski.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "mortise/core/errors.hpp"
#include "mortise/core/rigid_motion.hpp"

namespace mortise {
namespace {

Eigen::Matrix4Xd random_balls(int n, unsigned seed, double spread = 1.0) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-spread, spread);
  std::uniform_real_distribution<double> radius(0.05, 0.4);
  Eigen::Matrix4Xd result(4, n);
  for (int i = 0; i < n; ++i)
    result.col(i) << uniform(random), uniform(random), uniform(random), radius(random);
  return result;
}

// How far inside the union a point is (negative: outside).
template <class Matrix>
double depth(const Matrix& balls, const Eigen::Vector3d& x) {
  double best = -1e30;
  for (Eigen::Index i = 0; i < balls.cols(); ++i)
    best = std::max(best, static_cast<double>(balls(3, i)) -
                              (balls.col(i).template head<3>().template cast<double>() - x).norm());
  return best;
}

bool meet(const Eigen::Matrix4Xd& a, const Eigen::Matrix4Xd& b, const RigidMotion& motion,
          double offset, double* margin) {
  *margin = -1e30;
  for (Eigen::Index i = 0; i < a.cols(); ++i)
    for (Eigen::Index j = 0; j < b.cols(); ++j)
      *margin = std::max(
          *margin, a(3, i) + b(3, j) + offset -
                       (a.col(i).head<3>() - motion * Eigen::Vector3d(b.col(j).head<3>())).norm());
  return *margin >= 0.0;
}

TEST(Minkowski, SumHoldsEveryPairOnceAtItsPlace) {
  const Eigen::Matrix4Xd a = random_balls(37, 1);
  const Eigen::Matrix4Xd b = random_balls(23, 2);
  const Balls sum = minkowski_sum(a, b, {.offset = 0.125});
  ASSERT_EQ(sum.cols(), 37 * 23);
  for (Eigen::Index i = 0; i < a.cols(); ++i)
    for (Eigen::Index j = 0; j < b.cols(); ++j) {
      Eigen::Vector4d expected = a.col(i) + b.col(j);
      expected[3] += 0.125;
      EXPECT_LT((sum.col(i * b.cols() + j).cast<double>() - expected).cwiseAbs().maxCoeff(), 1e-6);
    }
}

TEST(Minkowski, ObstacleAnswersAsBallPairsDo) {
  const Eigen::Matrix4Xd a = random_balls(20, 3);
  const Eigen::Matrix4Xd b = random_balls(15, 4);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-2.5, 2.5);
  for (const double offset : {-0.2, 0.0, 0.3}) {
    RigidMotion motion;
    motion.rotation = Eigen::Quaterniond(0.3, -0.5, 0.7, 0.1).normalized();
    const Balls obstacle = translational_obstacle(a, b, motion.rotation, {.offset = offset});
    const Balls reduced = without_contained(obstacle, 24);
    int inside = 0;
    int outside = 0;
    for (int i = 0; i < 2000; ++i) {
      motion.translation = {uniform(random), uniform(random), uniform(random)};
      double margin = 0.0;
      const bool hit = meet(a, b, motion, offset, &margin);
      if (std::abs(margin) < 1e-5) continue;  // single precision may not tell
      (hit ? inside : outside) += 1;
      EXPECT_EQ(depth(obstacle, motion.translation) > 0.0, hit);
      EXPECT_EQ(depth(reduced, motion.translation) > 0.0, hit);
    }
    EXPECT_GT(inside, 50);
    EXPECT_GT(outside, 50);
  }
}

TEST(Minkowski, EqualRadiiAndTheLiftedFormAgree) {
  Eigen::Matrix4Xd a = random_balls(10, 6);
  Eigen::Matrix4Xd b = random_balls(12, 7);
  a.row(3).setConstant(0.2);
  b.row(3).setConstant(0.3);
  const Balls sum = minkowski_sum(a, b);
  EXPECT_TRUE((sum.row(3).array() == 0.5F).all());
}

TEST(Minkowski, ContainedBallsGoAndTheUnionStays) {
  for (const unsigned seed : {8U, 9U, 10U}) {
    const Balls sum = minkowski_sum(random_balls(40, seed), random_balls(40, seed + 10));
    for (const int cells : {2, 16, 64}) {
      const Balls reduced = without_contained(sum, cells);
      for (Eigen::Index i = 0; i < sum.cols(); ++i) {
        bool held = false;
        for (Eigen::Index j = 0; j < reduced.cols() && !held; ++j)
          held = (sum.col(i).head<3>() - reduced.col(j).head<3>()).norm() + sum(3, i) <=
                 reduced(3, j) * (1.0F + 1e-6F) + 1e-6F;
        ASSERT_TRUE(held) << "ball " << i << " lies in none that stays";
      }
      if (cells == 64) {
        Eigen::Index needed = 0;  // brute force: in no other ball
        for (Eigen::Index i = 0; i < sum.cols(); ++i) {
          bool held = false;
          for (Eigen::Index j = 0; j < sum.cols() && !held; ++j)
            held = j != i &&
                   (sum.col(i).head<3>() - sum.col(j).head<3>()).norm() + sum(3, i) <= sum(3, j);
          needed += held ? 0 : 1;
        }
        EXPECT_GE(reduced.cols(), needed);
        EXPECT_LT(needed, sum.cols() - 200);  // else the test shows nothing
        EXPECT_LE(static_cast<double>(reduced.cols() - needed),
                  0.5 * static_cast<double>(sum.cols() - needed));
      }
    }
  }
}

TEST(Minkowski, EqualBallsKeepOne) {
  const Balls balls = Eigen::Vector4f(1.0F, 2.0F, 3.0F, 0.5F).replicate(1, 7);
  EXPECT_EQ(without_contained(balls).cols(), 1);
  EXPECT_EQ(without_contained(Balls(4, 0)).cols(), 0);
}

TEST(Minkowski, SameBytesForAnyNumberOfThreads) {
  const Eigen::Matrix4Xd a = random_balls(300, 30);
  const Eigen::Matrix4Xd b = random_balls(400, 31);
  EXPECT_EQ(minkowski_sum(a, b, {.threads = 1}), minkowski_sum(a, b, {.threads = 3}));
}

TEST(Minkowski, RefusesBadInput) {
  Eigen::Matrix4Xd a = random_balls(3, 40);
  Eigen::Matrix4Xd bad = a;
  bad(1, 1) = std::nan("");
  EXPECT_THROW((void)minkowski_sum(a, bad), InputError);
  bad = a;
  bad(3, 0) = -1.0;
  EXPECT_THROW((void)minkowski_sum(bad, a), InputError);
  EXPECT_THROW((void)translational_obstacle(a, a, Eigen::Quaterniond(2, 0, 0, 0)), InputError);
  EXPECT_THROW((void)without_contained(Balls(4, 3), 1), InputError);
}

}  // namespace
}  // namespace mortise
