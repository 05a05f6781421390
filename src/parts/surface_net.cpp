// SPDX-License-Identifier: GPL-3.0-or-later
// One vertex a cell, two triangles an edge.
#include "mortise/parts/surface_net.hpp"

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "mortise/core/errors.hpp"

namespace mortise {
namespace {

constexpr std::array<std::array<int, 3>, 8> kCorners = {
    {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}}};
constexpr std::array<std::array<int, 2>, 12> kEdges = {{{0, 1},
                                                        {2, 3},
                                                        {4, 5},
                                                        {6, 7},
                                                        {0, 2},
                                                        {1, 3},
                                                        {4, 6},
                                                        {5, 7},
                                                        {0, 4},
                                                        {1, 5},
                                                        {2, 6},
                                                        {3, 7}}};

// The mean of the crossings of a cell's edges, in grid units from the cell's corner; false if
// there is none.
bool cell_vertex(const std::array<float, 8>& v, Eigen::Vector3d& mean) {
  mean.setZero();
  int crossings = 0;
  for (const auto& [a, b] : kEdges) {
    const auto u = static_cast<std::size_t>(a);
    const auto w = static_cast<std::size_t>(b);
    if ((v[u] <= 0.0F) == (v[w] <= 0.0F)) continue;
    const double t = -v[u] / (static_cast<double>(v[w]) - v[u]);
    for (int d = 0; d < 3; ++d) {
      const auto axis = static_cast<std::size_t>(d);
      mean[d] += kCorners[u][axis] + t * (kCorners[w][axis] - kCorners[u][axis]);
    }
    ++crossings;
  }
  if (crossings > 0) mean /= crossings;
  return crossings > 0;
}

// The grid with a layer of nodes outside all around it.
class Bordered {
 public:
  explicit Bordered(const DistanceGrid& grid) : grid_(grid), size_(grid.size + 2) {}

  [[nodiscard]] const Eigen::Array3i& size() const { return size_; }
  [[nodiscard]] float at(int i, int j, int k) const {
    const Eigen::Array3i node(i - 1, j - 1, k - 1);
    if ((node < 0).any() || (node >= grid_.size).any()) return static_cast<float>(grid_.spacing);
    return grid_.values[static_cast<std::size_t>(grid_.index(node[0], node[1], node[2]))];
  }
  [[nodiscard]] Eigen::Vector3d place(const Eigen::Vector3d& at) const {
    return grid_.origin + grid_.spacing * (at - Eigen::Vector3d::Ones());
  }
  [[nodiscard]] std::size_t index(const Eigen::Array3i& node) const {
    return (static_cast<std::size_t>(node[0]) * static_cast<std::size_t>(size_[1]) +
            static_cast<std::size_t>(node[1])) *
               static_cast<std::size_t>(size_[2]) +
           static_cast<std::size_t>(node[2]);
  }

 private:
  const DistanceGrid& grid_;
  Eigen::Array3i size_;
};

}  // namespace

TriangleMesh surface_net(const DistanceGrid& grid) {
  if (static_cast<Eigen::Index>(grid.values.size()) != grid.count())
    throw InputError("surface_net: expected " + std::to_string(grid.count()) + " values, got " +
                     std::to_string(grid.values.size()));
  const Bordered nodes(grid);
  const Eigen::Array3i& size = nodes.size();
  std::vector<std::int32_t> vertex_of(nodes.index({size[0], 0, 0}), -1);
  std::vector<Eigen::Vector3d> vertices;
  for (int i = 0; i + 1 < size[0]; ++i)
    for (int j = 0; j + 1 < size[1]; ++j)
      for (int k = 0; k + 1 < size[2]; ++k) {
        std::array<float, 8> v = {};
        for (std::size_t c = 0; c < 8; ++c)
          v[c] = nodes.at(i + kCorners[c][0], j + kCorners[c][1], k + kCorners[c][2]);
        Eigen::Vector3d at;
        if (!cell_vertex(v, at)) continue;
        vertex_of[nodes.index({i, j, k})] = static_cast<std::int32_t>(vertices.size());
        vertices.emplace_back(nodes.place(at + Eigen::Vector3d(i, j, k)));
      }
  // Each edge of the grid that crosses the level joins the vertices of the four cells around it.
  std::vector<Eigen::Vector3i> triangles;
  for (int i = 0; i + 1 < size[0]; ++i)
    for (int j = 0; j + 1 < size[1]; ++j)
      for (int k = 0; k + 1 < size[2]; ++k)
        for (int axis = 0; axis < 3; ++axis) {
          const Eigen::Array3i here(i, j, k);
          Eigen::Array3i next = here;
          ++next[axis];
          const bool inside = nodes.at(i, j, k) <= 0.0F;
          if (inside == (nodes.at(next[0], next[1], next[2]) <= 0.0F)) continue;
          const int u = (axis + 1) % 3;
          const int w = (axis + 2) % 3;
          std::array<std::int32_t, 4> corner = {};
          for (int c = 0; c < 4; ++c) {
            Eigen::Array3i cell = here;
            if (c == 0 || c == 3) --cell[u];
            if (c == 0 || c == 1) --cell[w];
            corner[static_cast<std::size_t>(c)] = vertex_of[nodes.index(cell)];
          }
          if (!inside) std::swap(corner[1], corner[3]);
          triangles.emplace_back(corner[0], corner[1], corner[2]);
          triangles.emplace_back(corner[0], corner[2], corner[3]);
        }
  TriangleMesh mesh;
  mesh.vertices.resize(3, static_cast<Eigen::Index>(vertices.size()));
  mesh.triangles.resize(3, static_cast<Eigen::Index>(triangles.size()));
  for (std::size_t n = 0; n < vertices.size(); ++n)
    mesh.vertices.col(static_cast<Eigen::Index>(n)) = vertices[n];
  for (std::size_t n = 0; n < triangles.size(); ++n)
    mesh.triangles.col(static_cast<Eigen::Index>(n)) = triangles[n];
  return mesh;
}

}  // namespace mortise
