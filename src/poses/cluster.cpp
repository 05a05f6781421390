// SPDX-License-Identifier: GPL-3.0-or-later
// Greedy clustering of ranked poses by ligand RMSD.
#include "mortise/poses/cluster.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <unordered_map>
#include <utility>

#include "mortise/core/errors.hpp"
#include "mortise/core/pose_distance.hpp"
#include "poses/cluster_sizes.hpp"

namespace mortise {
namespace {

// Founders by the cell of their centroid. Two poses within an RMSD have centroids within the same
// distance, so the 27 cells around a pose hold every founder that can take it.
class FounderCells {
 public:
  explicit FounderCells(double side) : side_(side) {}

  [[nodiscard]] std::array<std::int64_t, 3> cell(const Eigen::Vector3d& p) const {
    return {static_cast<std::int64_t>(std::floor(p[0] / side_)),
            static_cast<std::int64_t>(std::floor(p[1] / side_)),
            static_cast<std::int64_t>(std::floor(p[2] / side_))};
  }
  [[nodiscard]] static std::uint64_t key(std::int64_t i, std::int64_t j, std::int64_t k) {
    // 21 bits per axis; a collision only costs a wasted comparison.
    return (static_cast<std::uint64_t>(i) & 0x1fffff) << 42 |
           (static_cast<std::uint64_t>(j) & 0x1fffff) << 21 |
           (static_cast<std::uint64_t>(k) & 0x1fffff);
  }
  void add(const Eigen::Vector3d& p, int cluster) {
    const auto [i, j, k] = cell(p);
    cells_[key(i, j, k)].push_back(cluster);
  }
  // The smallest cluster number near p that `takes` accepts, or -1.
  template <class Takes>
  [[nodiscard]] int first(const Eigen::Vector3d& p, const Takes& takes) const {
    const auto [i, j, k] = cell(p);
    int best = -1;
    for (std::int64_t a = i - 1; a <= i + 1; ++a)
      for (std::int64_t b = j - 1; b <= j + 1; ++b)
        for (std::int64_t c = k - 1; c <= k + 1; ++c) {
          const auto found = cells_.find(key(a, b, c));
          if (found == cells_.end()) continue;
          for (const int cluster : found->second) {
            if (best >= 0 && cluster >= best) break;  // numbers rise within a cell
            if (takes(cluster)) best = cluster;
          }
        }
    return best;
  }

 private:
  double side_;
  std::unordered_map<std::uint64_t, std::vector<int>> cells_;
};

}  // namespace

Clusters cluster_poses(const std::vector<RigidMotion>& poses, const Eigen::Matrix3Xd& points,
                       const ClusterOptions& options) {
  detail::check_cluster_options(options.radius, options.min_size);
  const PoseDistance distance(points);
  const double radius_sq = options.radius * options.radius;
  // Cells may be larger than the radius; a lower bound keeps their numbers in range.
  FounderCells cells(std::max(options.radius, 1e-3));
  Clusters result{std::vector<int>(poses.size(), -1), {}, {}};
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Eigen::Vector3d centre = poses[i] * distance.centroid();
    if (!centre.allFinite())
      throw InputError("cluster: pose " + std::to_string(i) + " is not finite");
    int cluster = -1;
    if (radius_sq > 0.0)  // else nobody joins: the founders of one cell need not be gone through
      cluster = cells.first(centre, [&](int c) {
        return distance.mean_square(poses[result.founders[c]], poses[i]) < radius_sq;
      });
    if (cluster < 0) {
      if (options.max_clusters > 0 && result.founders.size() >= options.max_clusters) continue;
      cluster = static_cast<int>(result.founders.size());
      result.founders.push_back(i);
      cells.add(centre, cluster);
    }
    result.cluster_of[i] = cluster;
  }
  return detail::counted(std::move(result), options.min_size);
}

}  // namespace mortise
