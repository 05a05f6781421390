// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The boundary of a union of many balls as triangles.
#pragma once

#include <Eigen/Core>

#include "mortise/parts/triangle_mesh.hpp"

namespace mortise {

struct UnionMeshOptions {
  double spacing = 0.0;  ///< of the grid, length unit of the balls; 0 = longest side / 128
  int threads = 0;       ///< 0 = all cores; never changes the result
};

/// The union's boundary by surface_net() on a grid of its distances. Closed, normals outwards,
/// voids included. On a sphere of radius r the vertices lie within spacing^2 / r of it; gaps and
/// necks narrower than the spacing may close or break.
/// @param balls  4 x N, N >= 1: centre and radius >= 0
/// @throws InputError if there is no ball, something is not finite, a radius or the spacing is
/// negative, or the grid would have more than 2^28 nodes
/// Time about that of a few distances for each ball, and the cells at the boundary.
[[nodiscard]] TriangleMesh union_mesh(const Eigen::Matrix4Xd& balls,
                                      const UnionMeshOptions& options = {});

}  // namespace mortise
