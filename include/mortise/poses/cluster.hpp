// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Greedy clustering of ranked poses, by ligand RMSD or by interface RMSD.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "mortise/core/rigid_motion.hpp"

namespace mortise {

struct ClusterOptions {
  double radius = 3.0;           ///< RMSD below which two poses are one cluster, length unit; >= 0
  std::size_t max_clusters = 0;  ///< stop when so many have been founded; 0 = never
  std::size_t min_size = 1;      ///< clusters of fewer poses are dissolved; >= 1
};

/// Which cluster each pose belongs to and which pose founded it.
struct Clusters {
  std::vector<int> cluster_of;  ///< one per pose; -1 = past max_clusters, or of a dissolved cluster
  /// index of each cluster's representative: its first, best-ranked pose, within whose radius all
  /// others lie; rising
  std::vector<std::size_t> founders;
  std::vector<std::size_t> sizes = {};  ///< poses in each cluster, the founder included
};

/// Clusters by ligand RMSD: over the moving body's points, in the fixed body's frame.
///
/// Walks through poses, best first: each joins the first cluster whose founder lies within the
/// radius, or founds one. Clusters are numbered in the order of their founders.
/// @param poses   best first
/// @param points  3 x N, the moving body in its input frame
/// @throws InputError if an option is out of range, there is no point, or a point or pose is not
/// finite Time O(poses x clusters near by): founders are kept in cells of the radius' size.
[[nodiscard]] Clusters cluster_poses(const std::vector<RigidMotion>& poses,
                                     const Eigen::Matrix3Xd& points,
                                     const ClusterOptions& options = {});

struct InterfaceClusterOptions {
  double radius = 3.0;           ///< as ClusterOptions::radius
  std::size_t max_clusters = 0;  ///< as ClusterOptions::max_clusters
  std::size_t min_size = 1;      ///< as ClusterOptions::min_size
  double interface_cutoff =
      10.0;  ///< points this close to the partner are interface; length unit, > 0
};

/// Clusters by interface RMSD: over the points of both bodies that lie at the interface of the
/// founder's pose, after superposing just these; CAPRI's i-RMSD with the founder as reference.
///
/// The same walk as cluster_poses(). A founder whose bodies are farther apart than the cutoff has
/// no interface and stays alone.
/// @param poses   best first
/// @param fixed   3 x M, the fixed body in its input frame; backbone atoms for CAPRI's figure
/// @param moving  3 x N, the moving body in its input frame
/// @throws InputError as cluster_poses() Time O(poses x clusters) of a few ns each, and a
/// superposition for those near by.
[[nodiscard]] Clusters cluster_poses_by_interface(const std::vector<RigidMotion>& poses,
                                                  const Eigen::Matrix3Xd& fixed,
                                                  const Eigen::Matrix3Xd& moving,
                                                  const InterfaceClusterOptions& options = {});

}  // namespace mortise
