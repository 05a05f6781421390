// SPDX-License-Identifier: GPL-3.0-or-later
// Repairs that look at points and single triangles: equal points, triangles without area.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "parts/edge_table.hpp"

namespace mortise::parts {

/// What repair_mesh works on.
struct Surface {
  std::vector<Eigen::Vector3d> points;
  Triangles triangles;
  double diagonal = 0.0;  ///< of the bounding box of all points in use
};

/// Joins points with the same coordinates; returns how many there were too many.
long merge_equal_points(Surface& surface);

/// Joins points of `candidates` nearer than `tolerance` (in chains, so a little more may be
/// joined).
long merge_near_points(Surface& surface, const std::vector<int>& candidates, double tolerance);

/// Drops triangles with a repeated corner.
long drop_collapsed(Surface& surface);

/// Turns the longest edge of triangles without area over to the neighbour behind it, so that a
/// closed surface stays closed; drops those that stand alone. Returns how many there were.
long flatten_needles(Surface& surface);

/// Of triangles with the same three corners, keeps as many as one way exceeds the other, at most 1.
long drop_repeated(Surface& surface);

/// Of triangles that stand in the file both ways round, keeps the first, in pieces where most stand
/// so: both sides of a face as two triangles. Returns how many are dropped.
long drop_second_sides(Surface& surface);

/// Drops points that no triangle uses.
void drop_unused_points(Surface& surface);

/// Diagonal of the bounding box of the points in use.
[[nodiscard]] double diagonal_of(const Surface& surface);

/// Twice the area's vector.
[[nodiscard]] inline Eigen::Vector3d area_vector(const Surface& s, const std::array<int, 3>& t) {
  const auto point = [&](int k) {
    return s.points[static_cast<std::size_t>(t[static_cast<std::size_t>(k)])];
  };
  return (point(1) - point(0)).cross(point(2) - point(0));
}

}  // namespace mortise::parts
