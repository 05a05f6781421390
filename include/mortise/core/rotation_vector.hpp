// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Rotations from rotation vectors, and from one direction to another.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace mortise {

/// The rotation by |vector| radians about its direction; the identity for the zero vector.
[[nodiscard]] Eigen::Quaterniond rotation_from_vector(const Eigen::Vector3d& vector);

/// The rotation by the least angle that turns the direction of `from` to that of `to`, by a half
/// turn about some axis across where they are opposite. Neither may be zero.
[[nodiscard]] Eigen::Quaterniond rotation_between(const Eigen::Vector3d& from,
                                                  const Eigen::Vector3d& to);

}  // namespace mortise
