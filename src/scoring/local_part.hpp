// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A part about its own centre, in units of a given length: what single precision can hold.
#pragma once

#include <Eigen/Core>

#include "mortise/core/rigid_motion.hpp"
#include "mortise/parts/part.hpp"

namespace mortise {

/// local = (input - centre) / unit.
struct LocalFrame {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< input frame
  double unit = 1.0;                                 ///< input length unit; > 0

  [[nodiscard]] Eigen::Matrix3Xd to_local(const Eigen::Matrix3Xd& points) const;
  [[nodiscard]] Eigen::Matrix3Xd to_input(const Eigen::Matrix3Xd& points) const;
};

/// The part in a local frame; its solid asks the one given.
/// @throws InputError unless the frame is finite and its unit > 0
[[nodiscard]] Part local_part(const Part& part, const LocalFrame& frame);

/// A motion from one input frame to another, as one between local frames of the same unit.
[[nodiscard]] RigidMotion local_motion(const LocalFrame& fixed, const LocalFrame& moving,
                                       const RigidMotion& moving_in_fixed);
/// The inverse of local_motion().
[[nodiscard]] RigidMotion input_motion(const LocalFrame& fixed, const LocalFrame& moving,
                                       const RigidMotion& moving_in_fixed);

}  // namespace mortise
