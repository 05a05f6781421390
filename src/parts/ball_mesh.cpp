// SPDX-License-Identifier: GPL-3.0-or-later
// Balls as triangles.
#include "mortise/parts/ball_mesh.hpp"

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "mortise/core/errors.hpp"

namespace mortise {
namespace {

constexpr std::array<std::array<int, 3>, 20> kFaces = {
    {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
     {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
     {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};

Eigen::Matrix<double, 3, 12> icosahedron() {
  constexpr double g = std::numbers::phi;
  Eigen::Matrix<double, 3, 12> corners;
  corners << -1, 1, -1, 1, 0, 0, 0, 0, g, g, -g, -g,  //
      g, g, -g, -g, -1, 1, -1, 1, 0, 0, 0, 0,         //
      0, 0, 0, 0, g, g, -g, -g, -1, 1, -1, 1;
  return corners;
}

// The unit sphere: 10 cuts^2 + 2 vertices.
TriangleMesh unit_sphere(int cuts) {
  const Eigen::Matrix<double, 3, 12> corners = icosahedron();
  // Vertices are told apart by their place in the cut icosahedron, which sums of whole multiples of
  // the corners give alike from every face but for rounding.
  std::map<std::array<long, 3>, int> known;
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector3i> triangles;
  for (const std::array<int, 3>& face : kFaces) {
    const auto vertex = [&](int i, int j) {
      const Eigen::Vector3d p = (cuts - i - j) * corners.col(face[0]) + i * corners.col(face[1]) +
                                j * corners.col(face[2]);
      const std::array<long, 3> key = {std::lround(p.x() * 1e6), std::lround(p.y() * 1e6),
                                       std::lround(p.z() * 1e6)};
      const auto [entry, fresh] = known.try_emplace(key, static_cast<int>(points.size()));
      if (fresh) points.emplace_back(p.normalized());
      return entry->second;
    };
    for (int i = 0; i < cuts; ++i)
      for (int j = 0; j < cuts - i; ++j) {
        triangles.emplace_back(vertex(i, j), vertex(i + 1, j), vertex(i, j + 1));
        if (i + j < cuts - 1)
          triangles.emplace_back(vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1));
      }
  }
  TriangleMesh mesh;
  mesh.vertices.resize(3, static_cast<Eigen::Index>(points.size()));
  for (Eigen::Index v = 0; v < mesh.vertices.cols(); ++v) mesh.vertices.col(v) = points[v];
  mesh.triangles.resize(3, static_cast<Eigen::Index>(triangles.size()));
  for (Eigen::Index t = 0; t < mesh.size(); ++t) mesh.triangles.col(t) = triangles[t];
  return mesh;
}

}  // namespace

TriangleMesh ball_mesh(const Eigen::Matrix4Xd& balls, int cuts) {
  if (cuts < 1 || cuts > 32)
    throw InputError("ball_mesh: cuts must be 1 to 32, got " + std::to_string(cuts));
  const TriangleMesh sphere = unit_sphere(cuts);
  if (balls.cols() * sphere.size() > Eigen::Index{1} << 26)
    throw InputError("ball_mesh: at most 2^26 triangles expected, got " +
                     std::to_string(balls.cols()) + " balls of " + std::to_string(sphere.size()));
  TriangleMesh mesh;
  mesh.vertices.resize(3, balls.cols() * sphere.vertices.cols());
  mesh.triangles.resize(3, balls.cols() * sphere.size());
  for (Eigen::Index b = 0; b < balls.cols(); ++b) {
    mesh.vertices.middleCols(b * sphere.vertices.cols(), sphere.vertices.cols()) =
        (balls(3, b) * sphere.vertices).colwise() + Eigen::Vector3d(balls.col(b).head<3>());
    mesh.triangles.middleCols(b * sphere.size(), sphere.size()) =
        (sphere.triangles.array() + static_cast<int>(b * sphere.vertices.cols())).matrix();
  }
  return mesh;
}

}  // namespace mortise
