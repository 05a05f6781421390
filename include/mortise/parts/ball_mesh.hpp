// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Balls as triangles, to look at.
#pragma once

#include <Eigen/Core>

#include "mortise/parts/triangle_mesh.hpp"

namespace mortise {

/// Each ball as an icosahedron whose edges are cut into `cuts`, corners on its sphere: 20 cuts^2
/// triangles a ball.
/// @param balls  4 x N: centre and radius
/// @throws InputError if cuts is not in 1 to 32 or there are more than 2^26 triangles
[[nodiscard]] TriangleMesh ball_mesh(const Eigen::Matrix4Xd& balls, int cuts = 4);

}  // namespace mortise
