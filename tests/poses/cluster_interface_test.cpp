// SPDX-License-Identifier: GPL-3.0-or-later
// Clustering by interface RMSD against superposing the points themselves; sizes and small clusters.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>

#include "mortise/core/errors.hpp"
#include "mortise/metrics/superpose.hpp"
#include "mortise/poses/cluster.hpp"
#include "search/sample_bodies.hpp"

namespace mortise {
namespace {

using namespace sample_bodies;

Eigen::Matrix3Xd blob(std::mt19937& random, int count, const Eigen::Vector3d& half) {
  return ellipsoid(random, count, half, {1, -2, 3}, {1}).points.topRows<3>();
}

// Poses in touch with the fixed body, several around each of a few places.
std::vector<RigidMotion> touching_poses(std::mt19937& random, int count, double distance) {
  std::normal_distribution<double> normal;
  std::vector<RigidMotion> places, poses;
  for (int i = 0; i < 1 + count / 6; ++i) {
    places.push_back(random_motion(random, 1.0));
    places.back().translation = distance * places.back().translation.normalized();
  }
  std::uniform_int_distribution<std::size_t> pick(0, places.size() - 1);
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d axis = tests::random_vector(random);
    const RigidMotion step{
        Eigen::Quaterniond(Eigen::AngleAxisd(0.1 * normal(random), axis.normalized())),
        tests::random_vector(random)};
    poses.push_back(compose(step, places[pick(random)]));
  }
  return poses;
}

// Interface points of the founder, in its pose (first) and in another (second).
Clusters brute_force(const std::vector<RigidMotion>& poses, const Eigen::Matrix3Xd& fixed,
                     const Eigen::Matrix3Xd& moving, const InterfaceClusterOptions& options) {
  Clusters result{std::vector<int>(poses.size(), -1), {}, {}};
  const auto interface_rmsd = [&](const RigidMotion& founder, const RigidMotion& pose) {
    const Eigen::Matrix3Xd a = founder * moving, b = pose * moving;
    std::vector<Eigen::Vector3d> then, now;
    const auto near = [&](const Eigen::Vector3d& p, const Eigen::Matrix3Xd& others) {
      return (others.colwise() - p).colwise().norm().minCoeff() < options.interface_cutoff;
    };
    for (Eigen::Index i = 0; i < fixed.cols(); ++i)
      if (near(fixed.col(i), a)) {
        then.emplace_back(fixed.col(i));
        now.emplace_back(fixed.col(i));
      }
    for (Eigen::Index i = 0; i < moving.cols(); ++i)
      if (near(a.col(i), fixed)) {
        then.emplace_back(a.col(i));
        now.emplace_back(b.col(i));
      }
    if (then.empty()) return 1e9;
    Eigen::Matrix3Xd x(3, then.size()), y(3, now.size());
    for (std::size_t i = 0; i < then.size(); ++i) {
      x.col(static_cast<Eigen::Index>(i)) = then[i];
      y.col(static_cast<Eigen::Index>(i)) = now[i];
    }
    return superpose(y, x).rmsd;
  };
  for (std::size_t i = 0; i < poses.size(); ++i) {
    for (std::size_t c = 0; c < result.founders.size() && result.cluster_of[i] < 0; ++c)
      if (interface_rmsd(poses[result.founders[c]], poses[i]) < options.radius)
        result.cluster_of[i] = static_cast<int>(c);
    if (result.cluster_of[i] < 0) {
      result.cluster_of[i] = static_cast<int>(result.founders.size());
      result.founders.push_back(i);
      result.sizes.push_back(0);
    }
    ++result.sizes[result.cluster_of[i]];
  }
  return result;
}

TEST(ClusterPosesByInterface, EqualsTheGreedyWalkOverPoints) {
  std::mt19937 random(11);
  for (const int points : {3, 40, 150}) {
    const Eigen::Matrix3Xd fixed = blob(random, points, {20, 14, 12});
    const Eigen::Matrix3Xd moving = blob(random, points, {9, 12, 15});
    for (const double radius : {0.3, 2.0, 6.0}) {
      const std::vector<RigidMotion> poses = touching_poses(random, 70, 24.0);
      const InterfaceClusterOptions options{.radius = radius};
      const Clusters fast = cluster_poses_by_interface(poses, fixed, moving, options);
      const Clusters slow = brute_force(poses, fixed, moving, options);
      EXPECT_EQ(fast.cluster_of, slow.cluster_of) << points << ' ' << radius;
      EXPECT_EQ(fast.founders, slow.founders);
      EXPECT_EQ(fast.sizes, slow.sizes);
      if (points == 150 && radius == 2.0) {  // the sweep holds clusters of both kinds
        EXPECT_LT(fast.founders.size(), poses.size());
        EXPECT_GT(fast.founders.size(), 10U);
      }
    }
  }
}

TEST(ClusterPosesByInterface, BodiesApartStayAloneAndBadInputIsRefused) {
  std::mt19937 random(12);
  const Eigen::Matrix3Xd points = blob(random, 20, {5, 5, 5});
  const RigidMotion far{Eigen::Quaterniond::Identity(), {100, 0, 0}};
  EXPECT_EQ(cluster_poses_by_interface({far, far, {}, {}}, points, points).cluster_of,
            (std::vector<int>{0, 1, 2, 2}));
  const auto call = [&](const Eigen::Matrix3Xd& a, const Eigen::Matrix3Xd& b,
                        const InterfaceClusterOptions& options) {
    (void)cluster_poses_by_interface({{}}, a, b, options);
  };
  EXPECT_THROW(call(points, Eigen::Matrix3Xd(3, 0), {}), InputError);
  EXPECT_THROW(call(Eigen::Matrix3Xd(3, 0), points, {}), InputError);
  EXPECT_THROW(call(points * std::nan(""), points, {}), InputError);
  EXPECT_THROW(call(points, points, {.radius = -1.0}), InputError);
  EXPECT_THROW(call(points, points, {.min_size = 0}), InputError);
  EXPECT_THROW(call(points, points, {.interface_cutoff = 0.0}), InputError);
  RigidMotion lost;
  lost.translation[2] = std::nan("");
  EXPECT_THROW((void)cluster_poses_by_interface({lost}, points, points), InputError);
}

TEST(ClusterSizes, SmallClustersAreDissolvedAndTheOthersRenumbered) {
  const Eigen::Matrix3Xd points = Eigen::Matrix3Xd::Zero(3, 2);
  const auto at = [](double x) {
    return RigidMotion{Eigen::Quaterniond::Identity(), {x, 0.0, 0.0}};
  };
  const std::vector<RigidMotion> poses{at(0), at(50), at(51), at(90), at(91), at(89), at(0.5)};
  const Clusters all = cluster_poses(poses, points, {.radius = 3});
  EXPECT_EQ(all.sizes, (std::vector<std::size_t>{2, 2, 3}));
  const Clusters large = cluster_poses(poses, points, {.radius = 3, .min_size = 3});
  EXPECT_EQ(large.cluster_of, (std::vector<int>{-1, -1, -1, 0, 0, 0, -1}));
  EXPECT_EQ(large.founders, std::vector<std::size_t>{3});
  EXPECT_EQ(large.sizes, std::vector<std::size_t>{3});
  // Dissolving comes last: max_clusters counts those that were founded.
  EXPECT_EQ(cluster_poses(poses, points, {.radius = 3, .max_clusters = 2, .min_size = 2}).sizes,
            (std::vector<std::size_t>{2, 2}));
  EXPECT_THROW((void)cluster_poses(poses, points, {.min_size = 0}), InputError);
}

TEST(ClusterPosesByInterface, TenThousandPosesInReasonableTime) {
  std::mt19937 random(13);
  const Eigen::Matrix3Xd fixed = blob(random, 900, {30, 24, 22});
  const Eigen::Matrix3Xd moving = blob(random, 700, {20, 24, 22});
  const std::vector<RigidMotion> poses = touching_poses(random, 10000, 46.0);
  const auto start = std::chrono::steady_clock::now();
  const Clusters c = cluster_poses_by_interface(poses, fixed, moving, {.radius = 4.0});
  EXPECT_GT(c.founders.size(), 1000U);
  // docs/decisions.md has the time; sanitizers and a busy machine are far from the limit still.
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(60));
}

}  // namespace
}  // namespace mortise
