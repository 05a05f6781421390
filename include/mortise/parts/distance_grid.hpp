// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Nodes of a uniform grid around a body, and the signed distance at each of them.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <limits>
#include <vector>

#include "mortise/parts/solid.hpp"

namespace mortise {

/// Where the nodes of a grid lie, in the body's own frame and length unit.
struct GridNodes {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< node (0, 0, 0)
  double spacing = 1.0;                              ///< along each axis; > 0
  Eigen::Array3i size = Eigen::Array3i::Zero();      ///< nodes along each axis

  [[nodiscard]] Eigen::Index count() const noexcept {
    return Eigen::Index{size[0]} * size[1] * size[2];
  }
  /// Place of node (i, j, k) in an array of values: last axis fastest.
  [[nodiscard]] Eigen::Index index(int i, int j, int k) const noexcept {
    return (Eigen::Index{i} * size[1] + j) * size[2] + k;
  }
  [[nodiscard]] Eigen::Vector3d node(int i, int j, int k) const noexcept {
    return origin + spacing * Eigen::Vector3d(i, j, k);
  }
};

/// Signed distance to a body's boundary at grid nodes, negative inside.
struct DistanceGrid : GridNodes {
  std::vector<float> values;  ///< count() of them, by index()
};

struct DistanceGridOptions {
  /// Where the distance is larger, any value of the right sign and at least this size may be given;
  /// infinity = exact everywhere
  double band = std::numeric_limits<double>::infinity();
  int threads = 0;  ///< 0 = all cores; never changes the result
};

/// The grid of `nodes` nodes along the longest side of a box widened by `margin` on all sides, as
/// many as are needed along the others; centred on the box.
/// @param nodes   >= 2 @param margin  >= 0, length unit of the box
/// @throws InputError if the box is empty or not finite or a number is out of range
[[nodiscard]] GridNodes grid_around(const Eigen::AlignedBox3d& box, int nodes, double margin);

/// The same with `nodes` nodes along all three axes.
[[nodiscard]] GridNodes cubic_grid_around(const Eigen::AlignedBox3d& box, int nodes, double margin);

/// Distance at every node, in blocks of neighbours that start from each other's answer. Each value
/// is the float nearest to Solid::signed_distance.
/// @throws InputError if the grid is empty or not finite or an option is out of range
/// Memory 4 bytes per node.
[[nodiscard]] DistanceGrid distance_grid(const Solid& solid, const GridNodes& nodes,
                                         const DistanceGridOptions& options = {});

}  // namespace mortise
