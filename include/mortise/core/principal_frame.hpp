// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The principal axes of a set of points.
#pragma once

#include <Eigen/Core>

#include "mortise/core/rigid_motion.hpp"

namespace mortise {

/// Carries points to their principal axes, longest first, with the middle of their bounding box
/// there at the origin.
///
/// The frame depends on the shape alone: it is right-handed, and its first two axes point to the
/// side on which the points lie farther out (positive third moment). Where a shape is too symmetric
/// to tell, the axis' largest component in the input frame is positive.
/// @param points  3 x N, N >= 1
[[nodiscard]] RigidMotion principal_frame(const Eigen::Matrix3Xd& points);

}  // namespace mortise
