// SPDX-License-Identifier: GPL-3.0-or-later
// The exact Minkowski sum of two closed meshes, by CGAL.
#pragma once

#include "mortise/parts/triangle_mesh.hpp"

namespace mortise::reference {

TriangleMesh minkowski_sum(const TriangleMesh& a, const TriangleMesh& b);

}  // namespace mortise::reference
