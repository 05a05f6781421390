// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// How large a part is.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace mortise {

/// Indices of the vertices that lie farthest out along some of `directions` directions spread
/// evenly over the sphere; ascending. @throws InputError if there is no vertex
[[nodiscard]] std::vector<Eigen::Index> outermost_vertices(const Eigen::Matrix3Xd& vertices,
                                                           int directions = 600);

/// Largest distance between two vertices, length unit. Only the outermost vertices are compared, so
/// it is up to 0.5% too small. @throws InputError if there is no vertex
[[nodiscard]] double diameter_of(const Eigen::Matrix3Xd& vertices);

}  // namespace mortise
