// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Directions that a part's faces single out, and the rotations that lay those of two parts along
/// each other.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "mortise/parts/triangle_mesh.hpp"

namespace mortise {

/// Unit vectors in the part's frame, by decreasing area.
struct Directions {
  std::vector<Eigen::Vector3d> normals;  ///< outward, of flat faces
  std::vector<Eigen::Vector3d> axes;     ///< of turned faces: their normals lie all around it
};

/// Flat faces of at least 1% of the surface, at most 16, and axes of turned faces of at least 4%,
/// at most 3.
[[nodiscard]] Directions find_directions(const TriangleMesh& mesh);

/// 4 x N unit quaternions (w, x, y, z) that turn the moving part's directions into the fixed part's
/// frame so that two of them fall into place at once: normals against normals, axes along axes,
/// either way round; and for axes alone `turns` turns about them. No two within a degree; those of
/// the largest faces first.
/// @param most  of the first kind
[[nodiscard]] Eigen::Matrix4Xd aligned_rotations(const Directions& fixed, const Directions& moving,
                                                 int turns, int most);

}  // namespace mortise
