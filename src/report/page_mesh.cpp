// SPDX-License-Identifier: GPL-3.0-or-later
// Simplifying by meshoptimizer; cutting long edges in halves.
#include "report/page_mesh.hpp"

#include <meshoptimizer.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "mortise/parts/mesh_solid.hpp"
#include "mortise/parts/sample_surface.hpp"

namespace mortise::detail {
namespace {

constexpr Eigen::Index kMeasured = 20'000;  // points that the deviation is measured at

// The triangles over just the vertices they use, in their order.
TriangleMesh compact(const Eigen::Matrix3Xd& vertices, const std::vector<unsigned int>& corners) {
  std::vector<int> number(static_cast<std::size_t>(vertices.cols()), -1);
  for (const unsigned int corner : corners) number[corner] = 0;
  int next = 0;
  for (int& n : number)
    if (n == 0) n = next++;
  TriangleMesh mesh;
  mesh.vertices.resize(3, next);
  for (std::size_t v = 0; v < number.size(); ++v)
    if (number[v] >= 0) mesh.vertices.col(number[v]) = vertices.col(static_cast<Eigen::Index>(v));
  mesh.triangles.resize(3, static_cast<Eigen::Index>(corners.size() / 3));
  for (std::size_t c = 0; c < corners.size(); ++c)
    mesh.triangles(static_cast<Eigen::Index>(c % 3), static_cast<Eigen::Index>(c / 3)) =
        number[corners[c]];
  return mesh;
}

// One round: every edge longer than `most` gets a vertex at its middle, and each triangle is cut
// along those of its edges. False if there was none.
bool cut_once(std::vector<Eigen::Vector3d>& vertices, std::vector<Eigen::Vector3i>& triangles,
              double most) {
  std::unordered_map<std::uint64_t, int> middles;
  const auto middle = [&](int a, int b) {
    if (!((vertices[a] - vertices[b]).norm() > most)) return -1;
    const auto key = (static_cast<std::uint64_t>(std::min(a, b)) << 32) |
                     static_cast<std::uint32_t>(std::max(a, b));
    const auto [at, fresh] = middles.try_emplace(key, static_cast<int>(vertices.size()));
    if (fresh) vertices.emplace_back(0.5 * (vertices[a] + vertices[b]));
    return at->second;
  };
  std::vector<Eigen::Vector3i> cut;
  cut.reserve(2 * triangles.size());
  for (const Eigen::Vector3i& t : triangles) {
    const std::array<int, 3> m = {middle(t[0], t[1]), middle(t[1], t[2]), middle(t[2], t[0])};
    const auto halves = std::count_if(m.begin(), m.end(), [](int v) { return v >= 0; });
    if (halves == 0) {
      cut.push_back(t);
    } else if (halves == 3) {
      cut.emplace_back(t[0], m[0], m[2]);
      cut.emplace_back(m[0], t[1], m[1]);
      cut.emplace_back(m[2], m[1], t[2]);
      cut.emplace_back(m[0], m[1], m[2]);
    } else {
      // Turned so that the first edge is cut, and with two cuts the third is not.
      int k = 0;
      while (m[static_cast<std::size_t>(k)] < 0 ||
             (halves == 2 && m[static_cast<std::size_t>((k + 2) % 3)] >= 0))
        ++k;
      const int a = t[k], b = t[(k + 1) % 3], c = t[(k + 2) % 3];
      const int ab = m[static_cast<std::size_t>(k)], bc = m[static_cast<std::size_t>((k + 1) % 3)];
      if (halves == 1) {
        cut.emplace_back(a, ab, c);
        cut.emplace_back(ab, b, c);
      } else {
        cut.emplace_back(ab, b, bc);
        cut.emplace_back(a, ab, bc);
        cut.emplace_back(a, bc, c);
      }
    }
  }
  triangles.swap(cut);
  return !middles.empty();
}

}  // namespace

SimplifiedMesh simplified(const TriangleMesh& mesh, Eigen::Index most) {
  if (mesh.size() <= most) return {mesh, 0.0};
  // Single precision is enough for a picture once the mesh lies around the origin.
  const Eigen::Vector3d low = mesh.vertices.rowwise().minCoeff();
  const Eigen::Vector3d centre = 0.5 * (low + mesh.vertices.rowwise().maxCoeff());
  const Eigen::Matrix3Xf positions = (mesh.vertices.colwise() - centre).cast<float>();
  std::vector<unsigned int> corners(static_cast<std::size_t>(3 * mesh.size()));
  std::copy_n(mesh.triangles.data(), corners.size(), corners.begin());
  std::vector<unsigned int> kept(corners.size());
  constexpr float kAnyError = 1.0F;  // the count decides
  kept.resize(meshopt_simplify(kept.data(), corners.data(), corners.size(), positions.data(),
                               static_cast<std::size_t>(positions.cols()), 3 * sizeof(float),
                               static_cast<std::size_t>(3 * most), kAnyError, 0, nullptr));
  if (kept.empty()) return {mesh, 0.0};
  SimplifiedMesh made = {compact(mesh.vertices, kept), 0.0};
  made.deviation = MeshSolid(made.mesh, {.threads = 1})
                       .nearest(sample_surface(mesh, kMeasured).points)
                       .distances.maxCoeff();
  return made;
}

TriangleMesh cut_up(const TriangleMesh& mesh, Eigen::Index most) {
  if (mesh.size() == 0 || mesh.size() >= most) return mesh;
  const double diagonal =
      (mesh.vertices.rowwise().maxCoeff() - mesh.vertices.rowwise().minCoeff()).norm();
  // Halved edges are 3/4 of the longest in the mean: about 3 triangles in a square of that side.
  const double even = std::sqrt(3.0 * surface_area(mesh) / static_cast<double>(most));
  const double longest = std::max(diagonal / 40.0, even);
  std::vector<Eigen::Vector3d> vertices;
  std::vector<Eigen::Vector3i> triangles;
  for (Eigen::Index v = 0; v < mesh.vertices.cols(); ++v)
    vertices.emplace_back(mesh.vertices.col(v));
  for (Eigen::Index t = 0; t < mesh.size(); ++t) triangles.emplace_back(mesh.triangles.col(t));
  while (static_cast<Eigen::Index>(triangles.size()) < most &&
         cut_once(vertices, triangles, longest)) {
  }
  TriangleMesh cut;
  cut.vertices.resize(3, static_cast<Eigen::Index>(vertices.size()));
  cut.triangles.resize(3, static_cast<Eigen::Index>(triangles.size()));
  for (std::size_t v = 0; v < vertices.size(); ++v)
    cut.vertices.col(static_cast<Eigen::Index>(v)) = vertices[v];
  for (std::size_t t = 0; t < triangles.size(); ++t)
    cut.triangles.col(static_cast<Eigen::Index>(t)) = triangles[t];
  return cut;
}

}  // namespace mortise::detail
