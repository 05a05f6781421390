// SPDX-License-Identifier: GPL-3.0-or-later
// Gaussian density on a grid, and its level set by surface nets.
#include "report/density_surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "mortise/core/errors.hpp"

namespace mortise::detail {
namespace {

constexpr double kSoftness = 1.3;
constexpr double kReach = 2.2;  // radii; a ball's density there is below 0.7%
constexpr double kMostPoints = 2e7;

struct Density {
  Eigen::Vector3d origin;
  double spacing = 0.0;
  Eigen::Vector3i size;
  std::vector<float> values;  // x fastest

  [[nodiscard]] std::size_t index(int i, int j, int k) const {
    return static_cast<std::size_t>(i) +
           static_cast<std::size_t>(size[0]) *
               (static_cast<std::size_t>(j) +
                static_cast<std::size_t>(size[1]) * static_cast<std::size_t>(k));
  }
};

Density make_density(const Eigen::Matrix3Xd& centres, const Eigen::VectorXd& radii,
                     double spacing) {
  const double reach = kReach * radii.maxCoeff();
  const Eigen::Vector3d low = centres.rowwise().minCoeff().array() - reach;
  const Eigen::Vector3d extent =
      centres.rowwise().maxCoeff() - low + Eigen::Vector3d::Constant(reach);
  Density density;
  density.origin = low;
  density.spacing = std::max(spacing, std::cbrt(extent.prod() / kMostPoints));
  for (int d = 0; d < 3; ++d)
    density.size[d] = static_cast<int>(std::ceil(extent[d] / density.spacing)) + 2;
  density.values.assign(density.index(0, 0, density.size[2]), 0.0F);
  for (Eigen::Index a = 0; a < centres.cols(); ++a) {
    const Eigen::Vector3d at = (centres.col(a) - low) / density.spacing;
    const double r = radii[a] / density.spacing;
    const double scale = -kSoftness / (r * r);
    std::array<int, 3> from = {};
    std::array<int, 3> to = {};
    for (int d = 0; d < 3; ++d) {
      from[static_cast<std::size_t>(d)] =
          std::max(0, static_cast<int>(std::ceil(at[d] - kReach * r)));
      to[static_cast<std::size_t>(d)] =
          std::min(density.size[d] - 1, static_cast<int>(std::floor(at[d] + kReach * r)));
    }
    for (int k = from[2]; k <= to[2]; ++k)
      for (int j = from[1]; j <= to[1]; ++j) {
        const double rest = (k - at[2]) * (k - at[2]) + (j - at[1]) * (j - at[1]);
        float* row = density.values.data() + density.index(0, j, k);
        for (int i = from[0]; i <= to[0]; ++i)
          row[i] +=
              static_cast<float>(std::exp(kSoftness + scale * (rest + (i - at[0]) * (i - at[0]))));
      }
  }
  return density;
}

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
    if ((v[u] >= 1.0F) == (v[w] >= 1.0F)) continue;
    const double t = (1.0 - v[u]) / (static_cast<double>(v[w]) - v[u]);
    for (int d = 0; d < 3; ++d) {
      const auto axis = static_cast<std::size_t>(d);
      mean[d] += kCorners[u][axis] + t * (kCorners[w][axis] - kCorners[u][axis]);
    }
    ++crossings;
  }
  if (crossings > 0) mean /= crossings;
  return crossings > 0;
}

}  // namespace

TriangleMesh density_surface(const Eigen::Matrix3Xd& centres, const Eigen::VectorXd& radii,
                             double spacing) {
  if (centres.cols() == 0 || radii.size() != centres.cols() || !(radii.minCoeff() > 0.0))
    throw InputError("density_surface: expected one radius > 0 for each of at least one centre");
  if (!(spacing > 0.0))
    throw InputError("density_surface: spacing must be > 0, got " + std::to_string(spacing));
  const Density density = make_density(centres, radii, spacing);
  const Eigen::Vector3i size = density.size;
  std::vector<std::int32_t> vertex_of(density.values.size(), -1);
  std::vector<Eigen::Vector3d> vertices;
  for (int k = 0; k + 1 < size[2]; ++k)
    for (int j = 0; j + 1 < size[1]; ++j)
      for (int i = 0; i + 1 < size[0]; ++i) {
        std::array<float, 8> v = {};
        for (std::size_t c = 0; c < 8; ++c)
          v[c] = density.values[density.index(i + kCorners[c][0], j + kCorners[c][1],
                                              k + kCorners[c][2])];
        Eigen::Vector3d at;
        if (!cell_vertex(v, at)) continue;
        vertex_of[density.index(i, j, k)] = static_cast<std::int32_t>(vertices.size());
        vertices.emplace_back(density.origin + density.spacing * (at + Eigen::Vector3d(i, j, k)));
      }
  // Each edge of the grid that crosses the level joins the vertices of the four cells around it.
  std::vector<Eigen::Vector3i> triangles;
  for (int k = 1; k + 1 < size[2]; ++k)
    for (int j = 1; j + 1 < size[1]; ++j)
      for (int i = 1; i + 1 < size[0]; ++i)
        for (int axis = 0; axis < 3; ++axis) {
          Eigen::Vector3i here(i, j, k);
          Eigen::Vector3i next = here;
          ++next[axis];
          const bool inside = density.values[density.index(i, j, k)] >= 1.0F;
          if (inside == (density.values[density.index(next[0], next[1], next[2])] >= 1.0F))
            continue;
          const int u = (axis + 1) % 3;
          const int w = (axis + 2) % 3;
          std::array<int, 4> corner = {};
          for (int c = 0; c < 4; ++c) {
            Eigen::Vector3i cell = here;
            if (c == 0 || c == 3) --cell[u];
            if (c == 0 || c == 1) --cell[w];
            corner[static_cast<std::size_t>(c)] =
                vertex_of[density.index(cell[0], cell[1], cell[2])];
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

}  // namespace mortise::detail
