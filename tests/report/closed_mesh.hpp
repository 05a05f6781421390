// SPDX-License-Identifier: GPL-3.0-or-later
// Whether a mesh is closed, for tests of meshes the report makes.
#pragma once

#include <map>
#include <utility>

#include "mortise/parts/triangle_mesh.hpp"

namespace mortise::testing {

/// Each edge once one way and once the other: closed, no vertex on another's edge.
inline bool is_closed(const TriangleMesh& mesh) {
  std::map<std::pair<int, int>, int> sides;
  for (Eigen::Index t = 0; t < mesh.size(); ++t)
    for (int k = 0; k < 3; ++k) ++sides[{mesh.triangles(k, t), mesh.triangles((k + 1) % 3, t)}];
  for (const auto& [edge, count] : sides) {
    const auto back = sides.find({edge.second, edge.first});
    if (count != 1 || back == sides.end()) return false;
  }
  return true;
}

}  // namespace mortise::testing
