// SPDX-License-Identifier: GPL-3.0-or-later
// What two closed meshes have in common, by CGAL.
#pragma once

#include "mortise/parts/triangle_mesh.hpp"

namespace mortise::reference {

struct MeshOverlap {
  double volume = 0.0;  ///< of the intersection, by corefinement
  double depth = 0.0;   ///< largest distance of its surface from either mesh, over dense samples
};

/// @throws std::runtime_error if the meshes cannot be corefined
MeshOverlap mesh_overlap(const TriangleMesh& a, const TriangleMesh& b);

}  // namespace mortise::reference
