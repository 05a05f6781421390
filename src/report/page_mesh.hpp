// SPDX-License-Identifier: GPL-3.0-or-later
// Parts as a page can carry them: large meshes simplified, coarse ones cut up.
#pragma once

#include "mortise/parts/triangle_mesh.hpp"

namespace mortise::detail {

struct SimplifiedMesh {
  TriangleMesh mesh;
  // How far 20,000 even points of the full mesh lie from this one at most; 0: it is the full mesh.
  double deviation = 0.0;
};

// At most about `most` triangles: edges collapsed by quadric errors (M. Garland, P. S. Heckbert,
// SIGGRAPH 1997) in meshoptimizer, which keeps the topology, so that a mesh of many holes may stay
// larger; a smaller mesh as it is. Unused vertices are dropped.
[[nodiscard]] SimplifiedMesh simplified(const TriangleMesh& mesh, Eigen::Index most);

// The same surface with edges of at most about 1/40 of its diagonal, so that colours of vertices
// can show where something is; longer where that would take more than about `most` triangles. No
// vertex comes to lie on another triangle's edge; the mesh's own vertices come first.
[[nodiscard]] TriangleMesh cut_up(const TriangleMesh& mesh, Eigen::Index most);

}  // namespace mortise::detail
