// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Made-up hand motions for assembly sessions.
#pragma once

#include <cstdint>
#include <vector>

#include "mortise/core/rigid_motion.hpp"

namespace mortise {

struct HandPathOptions {
  double seconds = 10.0;  ///< > 0
  double rate = 1000.0;   ///< poses per second; > 0
  int visits = 4;         ///< places around the goal that are tried before it; >= 0
  double distance = 1.0;  ///< of those places from the goal, part of `radius`
  double angle = 0.5;     ///< largest turn at those places, radians
  double tremor = 0.002;  ///< rms of the hand's shaking (8 to 12 Hz), part of `radius`
  std::uint64_t seed = 1;
};

/// A hand that brings a part of the given radius (about `centre`, moving frame) to several places
/// near the goal, pushes it on from each towards the goal, backs off, and at last stays at the
/// goal. Segments are of minimum jerk; tremor is a sum of sines of random phase.
/// @throws InputError if an option is out of range or there were more than 2e7 poses
[[nodiscard]] std::vector<RigidMotion> hand_path(const RigidMotion& goal,
                                                 const Eigen::Vector3d& centre, double radius,
                                                 const HandPathOptions& options = {});

}  // namespace mortise
