// SPDX-License-Identifier: GPL-3.0-or-later
// Sphere trees: every ball in its parent, how tight, and distances by them against all balls.
#include "mortise/parts/sphere_tree.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "mortise/core/errors.hpp"

namespace mortise {
namespace {

Eigen::Matrix4Xd small_balls(int count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(-1.0, 1.0), radius(0.0, 0.1);
  Eigen::Matrix4Xd balls(4, count);
  for (int i = 0; i < count; ++i)
    balls.col(i) << 3.0 * place(random), place(random), 0.5 * place(random), radius(random);
  return balls;
}

// The leaves under a ball.
std::vector<int> leaves_under(const SphereTree& tree, int ball) {
  if (tree.children[ball] == 0) return {tree.leaf[ball]};
  std::vector<int> all;
  for (int c = 0; c < tree.children[ball]; ++c)
    for (const int leaf : leaves_under(tree, tree.first_child[ball] + c)) all.push_back(leaf);
  return all;
}

// The radius of the smallest ball around balls, from above: the farthest of them from a centre that
// moves towards it, ever slower.
double smallest_radius(const Eigen::Matrix4Xd& balls) {
  Eigen::Vector3d center = balls.topRows<3>().rowwise().mean();
  double best = std::numeric_limits<double>::infinity();
  for (int step = 1; step <= 4000; ++step) {
    Eigen::Index far = 0;
    const double radius =
        ((balls.topRows<3>().colwise() - center).colwise().norm() + balls.row(3)).maxCoeff(&far);
    best = std::min(best, radius);
    center += (Eigen::Vector3d(balls.col(far).head<3>()) - center) / (step + 1.0);
  }
  return best;
}

TEST(SphereTree, EveryBallLiesInItsParentForAllSizesAndArities) {
  for (const int count : {1, 2, 3, 4, 5, 17, 64, 65, 1000})
    for (const int arity : {2, 3, 4, 8, 64}) {
      SCOPED_TRACE(std::to_string(count) + " balls, arity " + std::to_string(arity));
      const Eigen::Matrix4Xd balls = small_balls(count, 3);
      const SphereTree tree = sphere_tree(balls, {.arity = arity});
      EXPECT_NO_THROW(check_sphere_tree(tree, count, "test"));
      for (int i = 0; i < tree.size(); ++i) {
        EXPECT_LE(tree.children[i], arity);
        if (tree.children[i] == 0) {
          EXPECT_EQ(tree.balls.col(i), balls.col(tree.leaf[i]));
        }
        for (int c = 0; c < tree.children[i]; ++c) {
          const int child = tree.first_child[i] + c;
          EXPECT_LE(
              (tree.balls.col(child) - tree.balls.col(i)).head<3>().norm() + tree.balls(3, child),
              tree.balls(3, i) * (1.0 + 1e-15));
        }
      }
      EXPECT_EQ(leaves_under(tree, 0).size(), static_cast<std::size_t>(count));
    }
}

TEST(SphereTree, ParentsAreTheSmallestBallsAroundTheirChildren) {
  const SphereTree tree = sphere_tree(small_balls(300, 5), {.arity = 6});
  for (int i = 0; i < tree.size(); ++i) {
    if (tree.children[i] == 0) continue;
    const Eigen::Matrix4Xd children = tree.balls.middleCols(tree.first_child[i], tree.children[i]);
    // The iteration stops a little above the smallest: 1 / steps of the radius.
    EXPECT_LE(tree.balls(3, i), smallest_radius(children) * (1.0 + 1e-9));
  }
}

TEST(SphereTree, AreNotMuchLargerThanTheBallsUnderThem) {
  const Eigen::Matrix4Xd balls = small_balls(2000, 7);
  for (const int arity : {2, 4, 8}) {
    const SphereTree tree = sphere_tree(balls, {.arity = arity});
    double worst = 1.0;
    for (int i = 0; i < std::min<Eigen::Index>(tree.size(), 100); ++i) {
      const std::vector<int> leaves = leaves_under(tree, i);
      Eigen::Matrix4Xd under(4, static_cast<Eigen::Index>(leaves.size()));
      for (std::size_t k = 0; k < leaves.size(); ++k) under.col(k) = balls.col(leaves[k]);
      worst = std::max(worst, tree.balls(3, i) / smallest_radius(under));
    }
    // Balls around balls around balls: measured 1.62, 1.37 and 1.21.
    EXPECT_LE(worst, arity == 2 ? 1.8 : 1.5) << "arity " << arity;
    RecordProperty("looseness_" + std::to_string(arity), std::to_string(worst));
  }
}

TEST(SphereTree, DistanceIsThatOfTheNearestBallOfAll) {
  const Eigen::Matrix4Xd balls = small_balls(777, 11);
  const SphereTree tree = sphere_tree(balls);
  Eigen::Matrix3Xd points = small_balls(2000, 13).topRows<3>() * 1.3;
  const Eigen::VectorXd found = distance_to_union(tree, points, 2);
  int inside = 0;
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const double expected =
        ((balls.topRows<3>().colwise() - points.col(i)).colwise().norm() - balls.row(3)).minCoeff();
    EXPECT_NEAR(found[i], expected, 1e-14);
    inside += expected < 0.0 ? 1 : 0;
  }
  EXPECT_GT(inside, 20);
  EXPECT_EQ(found, distance_to_union(tree, points, 1));
}

TEST(SphereTree, RefusesWhatIsNoTree) {
  const Eigen::Matrix4Xd balls = small_balls(20, 17);
  EXPECT_THROW((void)sphere_tree(Eigen::Matrix4Xd(4, 0)), InputError);
  EXPECT_THROW((void)sphere_tree(balls, {.arity = 1}), InputError);
  Eigen::Matrix4Xd bad = balls;
  bad(3, 4) = -0.1;
  EXPECT_THROW((void)sphere_tree(bad), InputError);
  bad(3, 4) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((void)sphere_tree(bad), InputError);

  const SphereTree good = sphere_tree(balls);
  EXPECT_THROW(check_sphere_tree(good, 19, "test"), InputError);
  EXPECT_THROW(check_sphere_tree(good, 21, "test"), InputError);
  SphereTree tree = good;
  tree.balls(3, 0) *= 0.99;
  EXPECT_THROW(check_sphere_tree(tree, 20, "test"), InputError);
  tree = good;
  tree.first_child[0] = 0;
  EXPECT_THROW(check_sphere_tree(tree, 20, "test"), InputError);
  tree = good;
  tree.children[0] = 1000;
  EXPECT_THROW(check_sphere_tree(tree, 20, "test"), InputError);
  tree = good;
  tree.leaf[tree.size() - 1] = tree.leaf[tree.size() - 2];
  EXPECT_THROW(check_sphere_tree(tree, 20, "test"), InputError);
}

}  // namespace
}  // namespace mortise
