// SPDX-License-Identifier: GPL-3.0-or-later
// The depth of a solid at the nodes of a cubic grid, and the grid's nodes in a ball.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "mortise/parts/distance_grid.hpp"

namespace mortise::parts {

inline constexpr double kHalfDiagonal = 0.5 * std::numbers::sqrt3;  // of a cell, in spacings

// Nodes and how deep in the solid they lie.
struct NodeField : GridNodes {
  std::vector<float> depth;  // distance to the boundary in spacings, positive inside

  [[nodiscard]] std::int64_t count() const { return static_cast<std::int64_t>(depth.size()); }
  [[nodiscard]] Eigen::Array3i node_at(std::int64_t index) const {
    const auto row = static_cast<int>(index / size.z());
    return {row / size.y(), row % size.y(), static_cast<int>(index % size.z())};
  }
};

// A ball in the coordinates of a grid: centre in nodes, radius in spacings.
struct GridBall {
  Eigen::Vector3d center;
  double radius = 0.0;
  bool added = false;  // for the boundary's sake, not by the reduction
};

// The centres of the cubic cells that fill a box, `grid` along its longest side.
GridNodes cell_centers(const Eigen::AlignedBox3d& box, int grid);

// @throws InputError if a distance is not finite
NodeField node_field(const DistanceGrid& grid);

// Calls row(first, last) with the indices of the nodes of each row along z that lie in the ball.
template <typename Row>
void for_rows_in(const NodeField& field, const GridBall& ball, const Row& row) {
  const double radius_sq = ball.radius * ball.radius;
  const auto low = [&](int axis, double half) {
    return std::max(0, static_cast<int>(std::ceil(ball.center[axis] - half)));
  };
  const auto high = [&](int axis, double half) {
    return std::min(field.size[axis] - 1, static_cast<int>(std::floor(ball.center[axis] + half)));
  };
  const int last_x = high(0, ball.radius);
  for (int x = low(0, ball.radius); x <= last_x; ++x) {
    const double rest_x = radius_sq - (x - ball.center[0]) * (x - ball.center[0]);
    if (rest_x < 0.0) continue;
    const double half_y = std::sqrt(rest_x);
    const int last_y = high(1, half_y);
    for (int y = low(1, half_y); y <= last_y; ++y) {
      const double rest = rest_x - (y - ball.center[1]) * (y - ball.center[1]);
      if (rest < 0.0) continue;
      const double half = std::sqrt(rest);
      const int first = low(2, half), last = high(2, half);
      if (first > last) continue;
      const std::int64_t start = field.index(x, y, 0);
      row(start + first, start + last);
    }
  }
}

}  // namespace mortise::parts
