// SPDX-License-Identifier: GPL-3.0-or-later
// Whether a mesh is closed, for tests of meshes the report makes.
#pragma once

#include <algorithm>
#include <map>
#include <utility>

#include "mortise/parts/triangle_mesh.hpp"

namespace mortise::testing {

/// Each edge as often one way as the other: nothing is open, no vertex lies on another's edge.
inline bool is_closed(const TriangleMesh& mesh) {
  std::map<std::pair<int, int>, int> sides;
  for (Eigen::Index t = 0; t < mesh.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const int a = mesh.triangles(k, t);
      const int b = mesh.triangles((k + 1) % 3, t);
      sides[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
    }
  return std::all_of(sides.begin(), sides.end(), [](const auto& side) { return side.second == 0; });
}

}  // namespace mortise::testing
