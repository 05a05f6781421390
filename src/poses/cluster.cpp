// SPDX-License-Identifier: GPL-3.0-or-later
// Greedy clustering of ranked poses by ligand RMSD.
#include "mortise/poses/cluster.hpp"

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>

#include "core/cell_hash.hpp"
#include "mortise/core/errors.hpp"
#include "mortise/core/pose_distance.hpp"
#include "poses/cluster_sizes.hpp"

namespace mortise {
Clusters cluster_poses(const std::vector<RigidMotion>& poses, const Eigen::Matrix3Xd& points,
                       const ClusterOptions& options) {
  detail::check_cluster_options(options.radius, options.min_size);
  const PoseDistance distance(points);
  const double radius_sq = options.radius * options.radius;
  // Founders by the cell of their centroid: two poses within an RMSD have centroids within the same
  // distance, so the cells around a pose hold every founder that can take it. Cells may be larger.
  detail::CellHash cells(std::max(options.radius, 1e-3));
  Clusters result{std::vector<int>(poses.size(), -1), {}, {}};
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Eigen::Vector3d centre = poses[i] * distance.centroid();
    if (!centre.allFinite())
      throw InputError("cluster: pose " + std::to_string(i) + " is not finite");
    int cluster = -1;
    if (radius_sq > 0.0)  // else nobody joins: the founders of one cell need not be gone through
      (void)cells.any_cell_around(centre, [&](const std::vector<std::int32_t>& founders) {
        for (const std::int32_t c : founders) {
          if (cluster >= 0 && c >= cluster) break;  // numbers rise within a cell
          if (distance.mean_square(poses[result.founders[c]], poses[i]) < radius_sq) cluster = c;
        }
        return false;
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
