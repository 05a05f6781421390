// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Slow, plain answers about a triangle mesh: CGAL's distance, the whole sum of solid angles.
#pragma once

#include <Eigen/Core>

#include "mortise/parts/triangle_mesh.hpp"

namespace mortise::reference {

/// Distance of each point to the mesh by CGAL's AABB tree, >= 0.
[[nodiscard]] Eigen::VectorXd distance(const TriangleMesh& mesh, const Eigen::Matrix3Xd& points);

/// Winding number of the mesh about one point: the solid angles of all its triangles, summed.
[[nodiscard]] double winding_number(const TriangleMesh& mesh, const Eigen::Vector3d& point);

}  // namespace mortise::reference
