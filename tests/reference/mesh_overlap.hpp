// SPDX-License-Identifier: GPL-3.0-or-later
// What two closed meshes have in common, by crossings of parallel lines.
#pragma once

#include "mortise/parts/triangle_mesh.hpp"

namespace mortise::reference {

struct MeshOverlap {
  double volume = 0.0;  ///< of the intersection
  double depth = 0.0;   ///< largest distance of its surface from either mesh, over dense samples
};

/// @throws std::runtime_error if a mesh is not closed
MeshOverlap mesh_overlap(const TriangleMesh& a, const TriangleMesh& b);

}  // namespace mortise::reference
