// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What the search keeps of one rotation.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "mortise/core/rigid_motion.hpp"

namespace mortise {

/// One of the best translations at one rotation, search frame: a local maximum of the score, or the
/// best that is left on the slope of a better one past the separation.
struct Candidate {
  std::int32_t rotation_index = -1;
  float score = 0.0F;                     ///< sum of all channels; at the sub-grid maximum
  std::array<float, 3> translation = {};  ///< of the moving body's centre
  std::int32_t offset_index = 0;          ///< of SearchOptions::offsets
};

/// Where candidates lie, for whoever has the run but not the search.
struct CandidateFrames {
  const Eigen::Matrix4Xd& rotations;  ///< 4 x N quaternions (w, x, y, z)
  RigidMotion search_from_fixed;      ///< fixed body's input frame to the search's
  RigidMotion search_from_moving;     ///< moving body's frame to the search's
};

/// A candidate as the motion of the moving body's frame into the fixed body's.
[[nodiscard]] RigidMotion candidate_motion(const Candidate& candidate,
                                           const CandidateFrames& frames);

}  // namespace mortise
