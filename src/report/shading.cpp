// SPDX-License-Identifier: GPL-3.0-or-later
// Corner normals and sharp edges of a mesh.
#include "report/shading.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace mortise::detail {
namespace {

// 3 x T normals, as long as twice the triangle's area.
Eigen::Matrix3Xd area_normals(const TriangleMesh& mesh) {
  Eigen::Matrix3Xd normals(3, mesh.size());
  for (Eigen::Index t = 0; t < mesh.size(); ++t) {
    const Eigen::Vector3d a = mesh.vertices.col(mesh.triangles(0, t));
    normals.col(t) = (mesh.vertices.col(mesh.triangles(1, t)) - a)
                         .cross(mesh.vertices.col(mesh.triangles(2, t)) - a);
  }
  return normals;
}

}  // namespace

Eigen::Matrix3Xd corner_normals(const TriangleMesh& mesh, double crease) {
  const Eigen::Matrix3Xd areas = area_normals(mesh);
  const Eigen::Matrix3Xd units = areas.colwise().normalized();
  std::vector<std::vector<int>> around(static_cast<std::size_t>(mesh.vertices.cols()));
  for (Eigen::Index t = 0; t < mesh.size(); ++t)
    for (int c = 0; c < 3; ++c)
      around[static_cast<std::size_t>(mesh.triangles(c, t))].push_back(static_cast<int>(t));
  const double least = std::cos(crease);
  Eigen::Matrix3Xd normals(3, 3 * mesh.size());
  for (Eigen::Index t = 0; t < mesh.size(); ++t)
    for (int c = 0; c < 3; ++c) {
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      for (const int other : around[static_cast<std::size_t>(mesh.triangles(c, t))])
        if (other == t || units.col(t).dot(units.col(other)) > least) sum += areas.col(other);
      const double length = sum.norm();
      normals.col(3 * t + c) =
          length > 0.0 ? Eigen::Vector3d(sum / length) : Eigen::Vector3d::UnitZ();
    }
  return normals;
}

Eigen::Matrix2Xi sharp_edges(const TriangleMesh& mesh, double crease) {
  const Eigen::Matrix3Xd units = area_normals(mesh).colwise().normalized();
  struct Side {
    int low = 0, high = 0, triangle = 0;
  };
  std::vector<Side> sides;
  for (Eigen::Index t = 0; t < mesh.size(); ++t)
    for (int c = 0; c < 3; ++c) {
      const int a = mesh.triangles(c, t);
      const int b = mesh.triangles((c + 1) % 3, t);
      sides.push_back({std::min(a, b), std::max(a, b), static_cast<int>(t)});
    }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::array{a.low, a.high, a.triangle} < std::array{b.low, b.high, b.triangle};
  });
  const double least = std::cos(crease);
  std::vector<Side> sharp;
  for (std::size_t i = 0; i < sides.size();) {
    std::size_t end = i;
    while (end < sides.size() && sides[end].low == sides[i].low && sides[end].high == sides[i].high)
      ++end;
    if (end - i != 2 || units.col(sides[i].triangle).dot(units.col(sides[i + 1].triangle)) < least)
      sharp.push_back(sides[i]);
    i = end;
  }
  Eigen::Matrix2Xi edges(2, static_cast<Eigen::Index>(sharp.size()));
  for (std::size_t i = 0; i < sharp.size(); ++i)
    edges.col(static_cast<Eigen::Index>(i)) << sharp[i].low, sharp[i].high;
  return edges;
}

}  // namespace mortise::detail
