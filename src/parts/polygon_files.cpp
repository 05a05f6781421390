// SPDX-License-Identifier: GPL-3.0-or-later
// Polygons of any format cut into triangles.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>

#include <algorithm>
#include <array>
#include <limits>

#include "mortise/core/errors.hpp"
#include "parts/mesh_files.hpp"

namespace mortise::parts {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Points = std::vector<Kernel::Point_3>;
using Polygon = std::vector<std::size_t>;

/// Triangles of a polygon: as the surface of least area through its corners, by CGAL.
void cut_up(const std::vector<Eigen::Vector3d>& points, const Polygon& polygon,
            std::vector<Eigen::Vector3i>& triangles) {
  const auto corner = [&](int i) { return static_cast<int>(polygon[static_cast<std::size_t>(i)]); };
  if (polygon.size() == 3) {
    triangles.emplace_back(corner(0), corner(1), corner(2));
    return;
  }
  constexpr std::size_t kMostCorners = 3000;
  std::vector<CGAL::Triple<int, int, int>> patch;
  if (polygon.size() <= kMostCorners) {
    Points outline;
    for (const std::size_t v : polygon)
      outline.emplace_back(points[v].x(), points[v].y(), points[v].z());
    CGAL::Polygon_mesh_processing::triangulate_hole_polyline(outline, std::back_inserter(patch));
  }
  for (const auto& t : patch) {
    std::array<int, 3> in_order = {t.first, t.second, t.third};
    std::sort(in_order.begin(), in_order.end());
    triangles.emplace_back(corner(in_order[0]), corner(in_order[1]), corner(in_order[2]));
  }
  if (!patch.empty()) return;
  for (int i = 1; i + 1 < static_cast<int>(polygon.size()); ++i)  // a fan, for want of better
    triangles.emplace_back(corner(0), corner(i), corner(i + 1));
}

}  // namespace

TriangleMesh triangulate(const std::string& path, const PolygonSoup& soup,
                         std::vector<std::string>& notes) {
  const auto& polygons = soup.polygons;
  const auto& points = soup.points;
  if (polygons.empty()) throw FileError(path, "expected faces, found none");
  constexpr std::size_t kMost = std::numeric_limits<int>::max() / 3;
  if (points.size() > kMost || polygons.size() > kMost) throw FileError(path, "too many triangles");
  TriangleMesh mesh;
  mesh.vertices.resize(3, static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i)
    mesh.vertices.col(static_cast<Eigen::Index>(i)) = points[i];
  std::vector<Eigen::Vector3i> triangles;
  triangles.reserve(polygons.size());
  long larger = 0;
  long smaller = 0;
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    for (const std::size_t v : polygons[i]) {
      if (v >= points.size())
        throw FileError(path, "face " + std::to_string(i) + " names vertex " +
                                  std::to_string(static_cast<long>(v)) + ", expected 0 to " +
                                  std::to_string(static_cast<long>(points.size()) - 1));
      if (!mesh.vertices.col(static_cast<Eigen::Index>(v)).allFinite())
        throw FileError(path, "vertex " + std::to_string(v) + " is not finite");
    }
    smaller += polygons[i].size() < 3;
    larger += polygons[i].size() > 3;
    if (polygons[i].size() >= 3) cut_up(points, polygons[i], triangles);
  }
  if (smaller > 0)
    notes.push_back("dropped " + std::to_string(smaller) + " faces of fewer than three corners");
  if (larger > 0) notes.push_back("cut " + std::to_string(larger) + " polygons into triangles");
  mesh.triangles.resize(3, static_cast<Eigen::Index>(triangles.size()));
  for (std::size_t i = 0; i < triangles.size(); ++i)
    mesh.triangles.col(static_cast<Eigen::Index>(i)) = triangles[i];
  return mesh;
}

}  // namespace mortise::parts
