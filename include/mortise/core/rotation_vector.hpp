// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Rotations from rotation vectors.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace mortise {

/// The rotation by |vector| radians about its direction; the identity for the zero vector.
[[nodiscard]] Eigen::Quaterniond rotation_from_vector(const Eigen::Vector3d& vector);

}  // namespace mortise
