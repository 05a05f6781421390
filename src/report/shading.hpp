// SPDX-License-Identifier: GPL-3.0-or-later
// What makes a mesh look like a body: normals that break at sharp edges, and those edges.
#pragma once

#include <Eigen/Core>

#include "mortise/parts/triangle_mesh.hpp"

namespace mortise::detail {

inline constexpr double kCrease = 0.5235987755982988;  // radians, 30 degrees

// 3 x 3T unit normals of the triangles' corners: the mean of the triangles around the vertex that
// bend by less than `crease` from this one, by area; pi makes all of them smooth.
[[nodiscard]] Eigen::Matrix3Xd corner_normals(const TriangleMesh& mesh, double crease = kCrease);

// 2 x E vertices of the edges that bend by more, or that not exactly two triangles share.
[[nodiscard]] Eigen::Matrix2Xi sharp_edges(const TriangleMesh& mesh, double crease = kCrease);

}  // namespace mortise::detail
