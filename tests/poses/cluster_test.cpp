// SPDX-License-Identifier: GPL-3.0-or-later
// Greedy clustering against the greedy walk over all founders.
#include "mortise/poses/cluster.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <limits>

#include "mortise/core/errors.hpp"
#include "mortise/core/pose_distance.hpp"
#include "search/sample_bodies.hpp"

namespace mortise {
namespace {

using namespace sample_bodies;

// Each pose against each founder in turn, with the distance summed over all points.
Clusters brute_force(const std::vector<RigidMotion>& poses, const Eigen::Matrix3Xd& points,
                     const ClusterOptions& options) {
  Clusters result{std::vector<int>(poses.size(), -1), {}, {}};
  for (std::size_t i = 0; i < poses.size(); ++i) {
    for (std::size_t c = 0; c < result.founders.size() && result.cluster_of[i] < 0; ++c) {
      const double mean_square =
          (poses[i] * points - poses[result.founders[c]] * points).colwise().squaredNorm().mean();
      if (std::sqrt(mean_square) < options.radius) result.cluster_of[i] = static_cast<int>(c);
    }
    if (result.cluster_of[i] >= 0) continue;
    if (options.max_clusters > 0 && result.founders.size() == options.max_clusters) continue;
    result.cluster_of[i] = static_cast<int>(result.founders.size());
    result.founders.push_back(i);
  }
  return result;
}

// Poses around few places, so that all sizes of cluster occur; also far out and negative.
std::vector<RigidMotion> random_poses(std::mt19937& random, int count, double spread) {
  std::vector<RigidMotion> centres, poses;
  for (int i = 0; i < 1 + count / 8; ++i) centres.push_back(random_motion(random, 25.0));
  std::normal_distribution<double> normal;
  std::uniform_int_distribution<std::size_t> pick(0, centres.size() - 1);
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d axis = tests::random_vector(random);
    const RigidMotion step{
        Eigen::Quaterniond(Eigen::AngleAxisd(0.05 * spread * normal(random), axis.normalized())),
        0.4 * spread * tests::random_vector(random)};
    poses.push_back(compose(step, centres[pick(random)]));
    poses.back().translation += 0.1 * axis;
  }
  return poses;
}

TEST(ClusterPoses, EqualsTheGreedyWalk) {
  std::mt19937 random(5);
  const Eigen::Matrix3Xd points =
      ellipsoid(random, 40, {20, 12, 9}, {3, 60, -9}, {1}).points.topRows<3>();
  for (const int count : {1, 2, 50, 600})
    for (const double radius : {0.3, 3.0, 8.0, 100.0})
      for (const std::size_t most : {std::size_t{0}, std::size_t{1}, std::size_t{7}}) {
        const std::vector<RigidMotion> poses = random_poses(random, count, 3.0);
        const ClusterOptions options{radius, most, 1};
        const Clusters fast = cluster_poses(poses, points, options);
        const Clusters slow = brute_force(poses, points, options);
        EXPECT_EQ(fast.cluster_of, slow.cluster_of) << count << ' ' << radius << ' ' << most;
        EXPECT_EQ(fast.founders, slow.founders);
      }
}

TEST(ClusterPoses, TheMiddleOfThreeByHand) {
  // Steps of 2 along x, radius 3: the third is 4 from the first founder, so it founds; the fourth
  // is within both and joins the better one.
  Eigen::Matrix3Xd points = Eigen::Matrix3Xd::Zero(3, 2);
  const auto at = [](double x) {
    return RigidMotion{Eigen::Quaterniond::Identity(), {x, 0.0, 0.0}};
  };
  const Clusters c = cluster_poses({at(0), at(2), at(4), at(2.5), at(-50)}, points, {.radius = 3});
  EXPECT_EQ(c.cluster_of, (std::vector<int>{0, 0, 1, 0, 2}));
  EXPECT_EQ(c.founders, (std::vector<std::size_t>{0, 2, 4}));
}

TEST(ClusterPoses, RadiusZeroKeepsAllAndEqualPosesAreOne) {
  std::mt19937 random(6);
  const Eigen::Matrix3Xd points =
      ellipsoid(random, 9, {5, 5, 5}, {0, 0, 0}, {1}).points.topRows<3>();
  const std::vector<RigidMotion> equal(500, random_motion(random, 10.0));
  EXPECT_EQ(cluster_poses(equal, points, {.radius = 0.5}).founders, std::vector<std::size_t>{0});
  EXPECT_EQ(cluster_poses(equal, points, {.radius = 0.0}).founders.size(), 500U);
  EXPECT_EQ(cluster_poses({}, points).founders.size(), 0U);
}

TEST(ClusterPoses, RefusesBadInput) {
  const Eigen::Matrix3Xd points = Eigen::Matrix3Xd::Zero(3, 1);
  EXPECT_THROW((void)cluster_poses({{}}, points, {.radius = -1.0}), InputError);
  EXPECT_THROW((void)cluster_poses({{}}, points, {.radius = std::nan("")}), InputError);
  EXPECT_THROW((void)cluster_poses({{}}, Eigen::Matrix3Xd(3, 0)), InputError);
  RigidMotion lost;
  lost.translation[1] = std::nan("");
  EXPECT_THROW((void)cluster_poses({lost}, points), InputError);
  // An infinite radius is one cluster.
  EXPECT_EQ(cluster_poses({{}, {}}, points, {.radius = std::numeric_limits<double>::infinity()})
                .founders.size(),
            1U);
}

TEST(ClusterPoses, TenThousandPosesInReasonableTime) {
  std::mt19937 random(7);
  const Eigen::Matrix3Xd points =
      ellipsoid(random, 500, {20, 20, 20}, {0, 0, 0}, {1}).points.topRows<3>();
  const auto start = std::chrono::steady_clock::now();
  // Radius zero and all in one place is the worst there is: every pose founds, in one cell.
  const std::vector<RigidMotion> equal(10000, random_motion(random, 10.0));
  EXPECT_EQ(cluster_poses(equal, points, {.radius = 0.0}).founders.size(), 10000U);
  const std::vector<RigidMotion> poses = random_poses(random, 10000, 3.0);
  EXPECT_GT(cluster_poses(poses, points, {.radius = 3.0}).founders.size(), 1000U);
  // 0.02 s measured; sanitizers and a busy machine are far from the limit still.
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(10));
}

}  // namespace
}  // namespace mortise
