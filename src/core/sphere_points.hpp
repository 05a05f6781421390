// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Points spread over a sphere.
#pragma once

#include <Eigen/Core>

namespace mortise::detail {

/// 3 x count nearly even unit vectors: equal steps in z, the golden angle in longitude.
[[nodiscard]] Eigen::Matrix3Xd fibonacci_sphere(int count);

}  // namespace mortise::detail
