// SPDX-License-Identifier: GPL-3.0-or-later
// Parts bounded by planes across the axes, wherever these stand: a peg, and holes with play.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <vector>

#include "mortise/parts/mesh_solid.hpp"
#include "mortise/parts/part.hpp"

namespace mortise::testing_parts {

/// The cells (i, j, k) between planes[0][i] and planes[0][i + 1] and so on that are filled.
inline Part boxy_part(const std::array<std::vector<double>, 3>& planes,
                      const std::function<bool(int, int, int)>& filled) {
  const auto at = [&](const std::array<int, 3>& c) {
    for (int d = 0; d < 3; ++d)
      if (c[d] < 0 || c[d] + 1 >= static_cast<int>(planes[d].size())) return false;
    return filled(c[0], c[1], c[2]);
  };
  std::vector<Eigen::Vector3d> vertices;
  std::vector<Eigen::Vector3i> triangles;
  for (int i = 0; i + 1 < static_cast<int>(planes[0].size()); ++i)
    for (int j = 0; j + 1 < static_cast<int>(planes[1].size()); ++j)
      for (int k = 0; k + 1 < static_cast<int>(planes[2].size()); ++k)
        for (int axis = 0; axis < 3; ++axis)
          for (const int side : {0, 1}) {
            const std::array<int, 3> here{i, j, k};
            std::array<int, 3> next = here;
            next[axis] += 2 * side - 1;
            if (!at(here) || at(next)) continue;
            const int u = (axis + 1) % 3, w = (axis + 2) % 3;
            const auto v = static_cast<int>(vertices.size());
            for (const auto& [a, b] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}}) {
              Eigen::Vector3d corner;
              corner[axis] = planes[axis][here[axis] + side];
              corner[u] = planes[u][here[u] + a];
              corner[w] = planes[w][here[w] + b];
              vertices.push_back(corner);
            }
            if (side == 1) {
              triangles.emplace_back(v, v + 1, v + 2);
              triangles.emplace_back(v, v + 2, v + 3);
            } else {
              triangles.emplace_back(v, v + 2, v + 1);
              triangles.emplace_back(v, v + 3, v + 2);
            }
          }
  TriangleMesh mesh;
  mesh.vertices.resize(3, static_cast<Eigen::Index>(vertices.size()));
  mesh.triangles.resize(3, static_cast<Eigen::Index>(triangles.size()));
  for (std::size_t n = 0; n < vertices.size(); ++n)
    mesh.vertices.col(static_cast<Eigen::Index>(n)) = vertices[n];
  for (std::size_t n = 0; n < triangles.size(); ++n)
    mesh.triangles.col(static_cast<Eigen::Index>(n)) = triangles[n];
  return {mesh, std::make_shared<MeshSolid>(mesh)};
}

/// A square peg, 6 x 6 x 9.
inline Part peg() {
  return boxy_part({{{0.0, 6.0}, {0.0, 6.0}, {0.0, 9.0}}}, [](int, int, int) { return true; });
}

/// A block of 20 x 16 x 10 with a blind hole, `play` wider on every side than the peg standing at
/// (6, 5), its floor at z = 4.
inline Part peg_block(double play) {
  return boxy_part({{{0.0, 6.0 - play, 12.0 + play, 20.0},
                     {0.0, 5.0 - play, 11.0 + play, 16.0},
                     {0.0, 4.0, 10.0}}},
                   [](int i, int j, int k) { return !(i == 1 && j == 1 && k == 1); });
}

}  // namespace mortise::testing_parts
