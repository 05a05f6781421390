// SPDX-License-Identifier: GPL-3.0-or-later
// Rings by walking, their triangles by CGAL.
#include "parts/holes.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <map>

namespace mortise::parts {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

constexpr std::size_t kMostEdges = 3000;  ///< CGAL's search grows with the cube of it at worst

/// Simple rings of points; each ring runs the way the missing triangles do.
std::vector<std::vector<int>> rings_of(const std::vector<OpenEdge>& open) {
  std::map<int, std::vector<int>> ways;  // missing sides, by where they start
  for (const OpenEdge& edge : open) {
    for (int i = 0; i < edge.times; ++i) ways[edge.to].push_back(edge.from);
  }
  std::vector<std::vector<int>> rings;
  std::map<int, std::size_t> place;  // on the path
  for (auto& [start, first_ways] : ways) {
    while (!first_ways.empty()) {
      std::vector<int> path = {start};
      place = {{start, 0}};
      while (!path.empty()) {
        auto& next = ways[path.back()];
        if (next.empty()) break;  // cannot be: as many sides leave a point as reach it
        const int to = next.back();
        next.pop_back();
        const auto met = place.find(to);
        if (met == place.end()) {
          place[to] = path.size();
          path.push_back(to);
          continue;
        }
        const auto begin = path.begin() + static_cast<std::ptrdiff_t>(met->second);
        rings.emplace_back(begin, path.end());
        for (auto p = begin + 1; p != path.end(); ++p) place.erase(*p);
        path.erase(begin + 1, path.end());
        if (path.size() == 1 && ways[path.back()].empty()) break;
      }
    }
  }
  return rings;
}

/// Whether the points of a ring lie within `distance` of a plane through their middle.
bool lies_flat(const Surface& surface, const std::vector<int>& ring, double distance) {
  Eigen::Matrix3Xd points(3, static_cast<Eigen::Index>(ring.size()));
  for (std::size_t i = 0; i < ring.size(); ++i)
    points.col(static_cast<Eigen::Index>(i)) = surface.points[static_cast<std::size_t>(ring[i])];
  points.colwise() -= points.rowwise().mean().eval();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(points * points.transpose());
  return (axes.eigenvectors().col(0).transpose() * points).cwiseAbs().maxCoeff() <= distance;
}

}  // namespace

Filled fill_holes(Surface& surface, const std::vector<OpenEdge>& open, double largest,
                  double flat) {
  Filled filled;
  for (const auto& ring : rings_of(open)) {
    if (ring.size() < 3 || ring.size() > kMostEdges) continue;
    Eigen::AlignedBox3d box;
    std::vector<Kernel::Point_3> polyline;
    for (const int v : ring) {
      const Eigen::Vector3d& p = surface.points[static_cast<std::size_t>(v)];
      box.extend(p);
      polyline.emplace_back(p.x(), p.y(), p.z());
    }
    const double extent = box.diagonal().norm();
    if (extent > largest && !(flat > 0.0 && lies_flat(surface, ring, flat))) continue;
    std::vector<CGAL::Triple<int, int, int>> patch;
    CGAL::Polygon_mesh_processing::triangulate_hole_polyline(polyline, std::back_inserter(patch));
    // CGAL gives up on rings along a straight line; what a fan makes of them has no area and goes
    // away later.
    for (int i = 1; patch.size() + 2 < ring.size() && i + 1 < static_cast<int>(ring.size()); ++i) {
      if (i == 1) patch.clear();
      patch.emplace_back(0, i, i + 1);
    }
    for (const auto& t : patch) {  // each with its corners in the ring's order
      std::array<int, 3> corners = {t.first, t.second, t.third};
      std::sort(corners.begin(), corners.end());
      surface.triangles.push_back({ring[static_cast<std::size_t>(corners[0])],
                                   ring[static_cast<std::size_t>(corners[1])],
                                   ring[static_cast<std::size_t>(corners[2])]});
    }
    ++filled.holes;
    filled.triangles += static_cast<long>(patch.size());
    filled.largest = std::max(filled.largest, extent);
  }
  return filled;
}

}  // namespace mortise::parts
