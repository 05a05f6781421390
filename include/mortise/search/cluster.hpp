// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Greedy clustering of ranked poses.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "mortise/core/rigid_motion.hpp"

namespace mortise {

struct ClusterOptions {
  double radius = 3.0;  ///< RMSD of the moving body's points below which two poses are one cluster,
                        ///< length unit; >= 0
  std::size_t max_clusters = 0;  ///< stop when so many have been founded; 0 = never
};

/// Which cluster each pose belongs to and which pose founded it.
struct Clusters {
  std::vector<int> cluster_of;        ///< one per pose; -1 = past max_clusters
  std::vector<std::size_t> founders;  ///< index of each cluster's first, best-ranked pose; rising
};

/// Walks through poses, best first: each joins the first cluster whose founder lies within the
/// radius, or founds one.
/// @param poses   best first
/// @param points  3 x N, the moving body in its input frame
/// @throws InputError if the radius is negative, there is no point, or a point or pose is not
/// finite Time O(poses x clusters near by): founders are kept in cells of the radius' size.
[[nodiscard]] Clusters cluster_poses(const std::vector<RigidMotion>& poses,
                                     const Eigen::Matrix3Xd& points,
                                     const ClusterOptions& options = {});

}  // namespace mortise
