// SPDX-License-Identifier: GPL-3.0-or-later
// The depth of a solid at the nodes of a cubic grid, and the grid's nodes in a ball.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "mortise/parts/solid.hpp"

namespace mortise::parts {

// Nodes are the centres of cubic cells that fill a box; the last index runs fastest.
struct NodeField {
  Eigen::Vector3d origin;    // node (0, 0, 0)
  double spacing = 0.0;      // between nodes
  Eigen::Array3i size;       // nodes along x, y, z
  std::vector<float> depth;  // distance to the boundary in spacings, positive inside

  [[nodiscard]] std::int64_t count() const { return static_cast<std::int64_t>(depth.size()); }
  [[nodiscard]] std::int64_t index(int x, int y, int z) const {
    return (static_cast<std::int64_t>(x) * size.y() + y) * size.z() + z;
  }
  [[nodiscard]] Eigen::Array3i node(std::int64_t index) const {
    const auto row = static_cast<int>(index / size.z());
    return {row / size.y(), row % size.y(), static_cast<int>(index % size.z())};
  }
  [[nodiscard]] Eigen::Vector3d position(const Eigen::Vector3d& node) const {
    return origin + spacing * node;
  }
};

// A ball in the coordinates of a grid: centre in nodes, radius in spacings.
struct GridBall {
  Eigen::Vector3d center;
  double radius = 0.0;
};

// The nodes of the box of the solid, `grid` along its longest side.
NodeField node_field(const Solid& solid, int grid, int threads);

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
