// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The order in which poses are gone through: by place.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "mortise/core/rigid_motion.hpp"

namespace mortise::detail {

/// Indices of poses along a Z-shaped curve through the places to which they move `centre`: those
/// that follow each other read the same part of the fixed body's maps.
[[nodiscard]] std::vector<std::size_t> by_place(const std::vector<RigidMotion>& poses,
                                                const Eigen::Vector3d& centre);

}  // namespace mortise::detail
