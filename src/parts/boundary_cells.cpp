// SPDX-License-Identifier: GPL-3.0-or-later
// Points on the boundary of a solid and the balls that reach them.
#include "parts/boundary_cells.hpp"

#include <algorithm>

namespace mortise::parts {
namespace {

Eigen::Vector3d gradient(const NodeField& field, const Eigen::Array3i& node) {
  Eigen::Vector3d result;
  for (int d = 0; d < 3; ++d) {
    Eigen::Array3i low = node, high = node;
    low[d] = std::max(0, node[d] - 1);
    high[d] = std::min(field.size[d] - 1, node[d] + 1);
    const int steps = high[d] - low[d];
    result[d] = steps == 0 ? 0.0
                           : (field.depth[field.index(high[0], high[1], high[2])] -
                              field.depth[field.index(low[0], low[1], low[2])]) /
                                 static_cast<double>(steps);
  }
  return result;
}

// Whether the node or one of the 26 about it lies inside.
bool inside_is_near(const NodeField& field, const Eigen::Array3i& node) {
  const Eigen::Array3i low = (node - 1).max(0), high = (node + 1).min(field.size - 1);
  for (int x = low.x(); x <= high.x(); ++x)
    for (int y = low.y(); y <= high.y(); ++y)
      for (int z = low.z(); z <= high.z(); ++z)
        if (field.depth[field.index(x, y, z)] > 0.0F) return true;
  return false;
}

}  // namespace

BoundaryPoints::BoundaryPoints(const NodeField& field)
    : field_(field), place_(field.depth.size(), -1) {
  for (std::int64_t i = 0; i < field.count(); ++i) {
    if (std::abs(field.depth[i]) >= kHalfDiagonal) continue;
    const Eigen::Array3i node = field.node_at(i);
    place_[i] = static_cast<std::int32_t>(points_.size());
    const Eigen::Vector3d inward = gradient(field, node).normalized();
    points_.push_back({i, node.cast<double>().matrix() - field.depth[i] * inward,
                       inside_is_near(field, node) ? kReach : kThinReach});
  }
}

double BoundaryPoints::outside(std::size_t point) const {
  return -field_.depth[points_[point].node];
}

Eigen::Vector3d BoundaryPoints::node(std::size_t point) const {
  return field_.node_at(points_[point].node).cast<double>();
}

std::vector<GridBall> boundary_balls(const BoundaryPoints& boundary,
                                     const std::vector<GridBall>& knots,
                                     const std::vector<GridBall>& candidates, double growth) {
  std::vector<char> open(boundary.size(), 1);
  for (const GridBall& ball : knots)
    boundary.for_reached(ball, [&](std::size_t point) { open[point] = 0; });
  std::vector<std::vector<std::size_t>> reached(candidates.size());
  std::vector<std::size_t> useful;
  for (std::size_t c = 0; c < candidates.size(); ++c) {
    boundary.for_reached(candidates[c], [&](std::size_t point) {
      if (open[point] != 0) reached[c].push_back(point);
    });
    if (!reached[c].empty()) useful.push_back(c);
  }
  // The candidate that reaches most open points, again and again.
  std::vector<GridBall> balls;
  while (!useful.empty()) {
    const std::size_t best =
        *std::max_element(useful.begin(), useful.end(), [&](std::size_t a, std::size_t b) {
          return reached[a].size() != reached[b].size() ? reached[a].size() < reached[b].size()
                                                        : a > b;
        });
    balls.push_back(candidates[best]);
    for (const std::size_t point : reached[best]) open[point] = 0;
    for (const std::size_t c : useful)
      std::erase_if(reached[c], [&](std::size_t point) { return open[point] == 0; });
    std::erase_if(useful, [&](std::size_t c) { return reached[c].empty(); });
  }
  for (std::size_t point = 0; point < open.size(); ++point)
    if (open[point] != 0 && boundary.outside(point) < growth)
      balls.push_back({boundary.node(point), growth - std::max(0.0, boundary.outside(point))});
  for (GridBall& ball : balls) ball.added = true;
  return balls;
}

std::vector<GridBall> without_needless(const NodeField& field, const BoundaryPoints& boundary,
                                       std::vector<GridBall> balls) {
  std::vector<std::int32_t> holders(field.depth.size(), 0), reachers(boundary.size(), 0);
  const auto for_each = [&](const GridBall& ball, const auto& call) {
    for_rows_in(field, ball, [&](std::int64_t first, std::int64_t last) {
      for (std::int64_t k = first; k <= last; ++k)
        if (field.depth[k] > 0.0F) call(holders[k]);
    });
    boundary.for_reached(ball, [&](std::size_t point) { call(reachers[point]); });
  };
  for (const GridBall& ball : balls) for_each(ball, [](std::int32_t& n) { ++n; });
  std::stable_sort(balls.begin(), balls.end(),
                   [](const GridBall& a, const GridBall& b) { return a.radius < b.radius; });
  std::erase_if(balls, [&](const GridBall& ball) {
    bool needed = false;
    for_each(ball, [&](std::int32_t n) { needed = needed || n == 1; });
    if (!needed) for_each(ball, [](std::int32_t& n) { --n; });
    return !needed;
  });
  return balls;
}

}  // namespace mortise::parts
