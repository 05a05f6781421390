// SPDX-License-Identifier: GPL-3.0-or-later
// Points spread over the boundary of meshes and solids.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "mortise/core/errors.hpp"
#include "mortise/core/threads.hpp"
#include "mortise/parts/distance_grid.hpp"
#include "mortise/parts/hausdorff.hpp"
#include "parts/node_field.hpp"

namespace mortise {
namespace {

void check_spacing(double spacing) {
  if (!(spacing > 0.0) || !std::isfinite(spacing))
    throw InputError("surface_samples: spacing must be > 0, got " + std::to_string(spacing));
}

Eigen::Matrix3Xd gathered(const std::vector<Eigen::Vector3d>& points) {
  Eigen::Matrix3Xd result(3, static_cast<Eigen::Index>(points.size()));
  for (Eigen::Index i = 0; i < result.cols(); ++i) result.col(i) = points[i];
  return result;
}

}  // namespace

Eigen::Matrix3Xd surface_samples(const TriangleMesh& mesh, double spacing) {
  check_spacing(spacing);
  // A triangle is cut into n^2 like itself; no point of one of them is further from its corners
  // than its longest edge over sqrt(3) (obtuse ones: over 2), so n = longest / (sqrt(3) spacing).
  const auto cuts = [&](Eigen::Index t) {
    double longest = 0.0;
    for (int e = 0; e < 3; ++e)
      longest = std::max(longest, (mesh.vertices.col(mesh.triangles(e, t)) -
                                   mesh.vertices.col(mesh.triangles((e + 1) % 3, t)))
                                      .norm());
    return std::max(1.0, std::ceil(longest / (std::numbers::sqrt3 * spacing)));
  };
  double total = static_cast<double>(mesh.vertices.cols());
  for (Eigen::Index t = 0; t < mesh.size(); ++t) total += 0.5 * (cuts(t) + 1.0) * (cuts(t) + 2.0);
  if (!(total < std::ldexp(1.0, 28)))
    throw InputError("surface_samples: fewer than 2^28 samples expected, spacing " +
                     std::to_string(spacing) + " is too small for the mesh");
  std::vector<Eigen::Vector3d> points;
  std::vector<char> used(static_cast<std::size_t>(mesh.vertices.cols()), 0);
  for (Eigen::Index t = 0; t < mesh.size(); ++t) {
    const Eigen::Vector3d a = mesh.vertices.col(mesh.triangles(0, t));
    const Eigen::Vector3d b = mesh.vertices.col(mesh.triangles(1, t));
    const Eigen::Vector3d c = mesh.vertices.col(mesh.triangles(2, t));
    for (int corner = 0; corner < 3; ++corner) used[mesh.triangles(corner, t)] = 1;
    const auto n = static_cast<int>(cuts(t));
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j <= n - i; ++j)
        if (i != n && j != n && i + j != 0)
          points.emplace_back(a + (i * (b - a) + j * (c - a)) / n);
  }
  for (Eigen::Index v = 0; v < mesh.vertices.cols(); ++v)
    if (used[v] != 0) points.emplace_back(mesh.vertices.col(v));
  return gathered(points);
}

Eigen::Matrix3Xd surface_samples(const Solid& solid, double spacing, int threads) {
  check_spacing(spacing);
  const Eigen::AlignedBox3d box = solid.bounds();
  const double cells = box.isEmpty() ? 0.0 : box.sizes().maxCoeff() / spacing;
  if (!(cells <= 1024.0))
    throw InputError("surface_samples: at most 1024 samples along the solid expected, got " +
                     std::to_string(cells));
  const double near = 0.87 * spacing;  // half the diagonal of a cell
  const GridNodes nodes =
      grid_around(box, std::max(2, static_cast<int>(std::ceil(cells)) + 1), spacing);
  const DistanceGrid grid =
      distance_grid(solid, nodes, {.band = 2.0 * spacing, .threads = threads});
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < nodes.size.x(); ++i)
    for (int j = 0; j < nodes.size.y(); ++j)
      for (int k = 0; k < nodes.size.z(); ++k)
        if (std::abs(grid.values[nodes.index(i, j, k)]) <= near)
          points.push_back(nodes.node(i, j, k));
  Eigen::Matrix3Xd surface = gathered(points);
  const double step = 1e-5 * spacing;
  Eigen::VectorXd distance;
  for (int round = 0; round < 3; ++round) {
    distance = solid.signed_distance(surface, 3.0 * spacing);
    Eigen::Matrix3Xd gradient(3, surface.cols());
    for (int d = 0; d < 3; ++d) {
      Eigen::Matrix3Xd beside = surface;
      beside.row(d).array() += step;
      gradient.row(d) = (solid.signed_distance(beside, 3.0 * spacing) - distance) / step;
    }
    for (Eigen::Index i = 0; i < surface.cols(); ++i)
      surface.col(i) -=
          distance[i] / std::max(gradient.col(i).norm(), 0.5) * gradient.col(i).normalized();
  }
  distance = solid.signed_distance(surface, 3.0 * spacing);
  std::vector<Eigen::Vector3d> found;  // without those caught between two sides
  for (Eigen::Index i = 0; i < surface.cols(); ++i)
    if (std::abs(distance[i]) < 1e-3 * spacing) found.emplace_back(surface.col(i));
  return gathered(found);
}

}  // namespace mortise
