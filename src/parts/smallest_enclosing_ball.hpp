// SPDX-License-Identifier: GPL-3.0-or-later
// The smallest ball around balls.
#pragma once

#include <Eigen/Core>

namespace mortise::parts {

// The smallest ball that holds the given ones (4 x N, N >= 1: centre, radius), its radius such that
// |x_i - x| + r_i <= r for each as computed.
Eigen::Vector4d smallest_enclosing_ball(const Eigen::Matrix4Xd& balls);

}  // namespace mortise::parts
