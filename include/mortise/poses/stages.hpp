// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// From candidates to a ranked list: stages that move, score, cluster and select poses, as data.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "mortise/core/pose.hpp"
#include "mortise/scoring/pose_scorer.hpp"

namespace mortise {

/// One step of the ranking. Poses are moved, scored, ranked; then the best of each cluster is kept.
struct Stage {
  std::string name;                               ///< for people: "contact", "polish"
  MovePoses move = {};                            ///< empty = poses stay where they are
  std::shared_ptr<const PoseScorer> scorer = {};  ///< none = poses keep the score they have
  bool replaces = false;  ///< the scorer's columns replace the poses' own; false = they are added
  std::size_t keep = 0;   ///< clusters kept at most; 0 = all
  double cluster_radius = 0.0;  ///< poses whose RMSD over the moving points to a better one is
                                ///< below are dropped, length unit; 0 = none
};

/// What the stages made of the poses.
struct StagedPoses {
  PoseList list;
  std::vector<double> seconds;  ///< wall time of each stage
};

/// Runs the stages one after the other. Poses of the result are best first; equal scores stay in
/// the order given. Each is its own cluster, numbered from 0.
/// @param points   3 x N, of the moving body, input frame: what RMSDs are taken over
/// @throws InputError as cluster_poses(), or if a scorer's or mover's answer has another size or is
/// not finite
[[nodiscard]] StagedPoses run_stages(PoseList poses, const std::vector<Stage>& stages,
                                     const Eigen::Matrix3Xd& points, int threads);

}  // namespace mortise
