// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Refinement of poses on SE(3): each is moved uphill on a score with a gradient.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "mortise/core/rigid_motion.hpp"
#include "mortise/scoring/score_maps.hpp"

namespace mortise {

/// Score and derivatives at a pose; called from several threads at once.
using PoseObjective = std::function<PlacedScore(const RigidMotion& moving_in_fixed)>;

struct PolishOptions {
  int evaluations = 8;        ///< of the score, at most, for each pose; >= 1
  double first_step = 0.5;    ///< length of a pose's first trial step, RMSD of the moving body; > 0
  double longest_step = 1.0;  ///< of any step, likewise; > 0
  double tolerance = 0.02;    ///< a pose is done when its next step would be shorter; > 0
  int threads = 0;            ///< 0 = all cores; never changes the result
};

/// How the moving body turns: torques are about `centre`, rotations count by its `gyration`.
struct PolishBody {
  Eigen::Vector3d centre;  ///< in the moving body's input frame
  double gyration = 1.0;   ///< rms distance of its points from the centre; > 0
};

struct PolishedPose {
  RigidMotion moving_in_fixed;
  double start = 0.0;   ///< score where it began
  double score = 0.0;   ///< where it ended; >= start
  int evaluations = 0;  ///< of the score
};

/// Moves each pose uphill by BFGS steps with backtracking on SE(3) (docs/math.md). A pose never
/// ends lower than it began; each is moved by itself, so that the result depends neither on the
/// others nor on threads.
/// @throws InputError if an option or the body is out of range
/// Time O(poses x evaluations).
[[nodiscard]] std::vector<PolishedPose> polish_poses(const PoseObjective& objective,
                                                     const PolishBody& body,
                                                     const std::vector<RigidMotion>& poses,
                                                     const PolishOptions& options = {});

}  // namespace mortise
