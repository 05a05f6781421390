// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// One placement of the moving body, with its score.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mortise/core/rigid_motion.hpp"

namespace mortise {

/// One scored placement: `moving_in_fixed` carries the moving body's input coordinates into the
/// fixed body's input frame.
struct Pose {
  RigidMotion moving_in_fixed;
  double score = 0.0;                ///< what poses are ranked by; higher is better
  std::vector<double> channels;      ///< one value per entry of PoseList::channel_names
  std::int32_t rotation_index = -1;  ///< row of the run's rotation set; -1 = not from a set
  std::int32_t cluster = -1;         ///< 0-based, by rank of its best pose; -1 = not clustered
  std::int32_t candidate = -1;       ///< which of the run's candidates it was; -1 = none of them
};

/// Poses in rank order (best first) and the names of their score channels.
struct PoseList {
  std::vector<std::string> channel_names;
  std::vector<Pose> poses;
};

}  // namespace mortise
