// SPDX-License-Identifier: GPL-3.0-or-later
// Nearest points by growing shells of cells.
#include "core/nearest_point.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace mortise::detail {

NearestPoint::Found NearestPoint::operator()(const Eigen::Vector3d& p, double limit) const {
  Found best{-1, limit * limit};
  if (grid_.order.empty()) return best;
  const Eigen::Array3d u = grid_.place(p);
  // A place outside the cells starts from the cell it would be in; no farther than needed.
  std::int64_t home[3], nearest = 0, farthest = 0;  // shells: cells by the largest coordinate
  double margin = 0.5;  // from p to the nearest wall of its cell, in cells
  for (int d = 0; d < 3; ++d) {
    const double floor = std::floor(std::clamp(u[d], -1e9, 1e9));
    margin = std::clamp(std::min(u[d] - floor, floor + 1.0 - u[d]), 0.0, margin);
    home[d] = static_cast<std::int64_t>(floor);
    nearest = std::max({nearest, -home[d], home[d] - (grid_.counts[d] - 1)});
    farthest = std::max({farthest, home[d], grid_.counts[d] - 1 - home[d]});
  }
  std::int32_t slot = -1;
  const auto look = [&](std::int64_t from, std::int64_t to) {  // cells of one row
    for (std::int32_t k = grid_.starts[from]; k < grid_.starts[to + 1]; ++k) {
      const double dx = grid_.x[k] - p.x(), dy = grid_.y[k] - p.y(), dz = grid_.z[k] - p.z();
      const double distance_sq = dx * dx + dy * dy + dz * dz;
      if (distance_sq < best.distance_sq) {
        best.distance_sq = distance_sq;
        slot = k;
      }
    }
  };
  for (std::int64_t shell = nearest; shell <= farthest; ++shell) {
    // Whole cells lie between p and this shell.
    const double beyond = (static_cast<double>(shell - 1) + margin) * grid_.edge;
    if (shell > 0 && beyond * beyond >= best.distance_sq) break;
    for (std::int64_t z = std::max<std::int64_t>(0, home[2] - shell);
         z <= std::min(grid_.counts[2] - 1, home[2] + shell); ++z)
      for (std::int64_t y = std::max<std::int64_t>(0, home[1] - shell);
           y <= std::min(grid_.counts[1] - 1, home[1] + shell); ++y) {
        const std::int64_t row = grid_.counts[0] * (y + grid_.counts[1] * z);
        const std::int64_t low = home[0] - shell, high = home[0] + shell;
        if (std::abs(y - home[1]) == shell || std::abs(z - home[2]) == shell) {
          const std::int64_t from = std::max<std::int64_t>(0, low),
                             to = std::min(grid_.counts[0] - 1, high);
          if (from <= to) look(row + from, row + to);
        } else {
          if (low >= 0 && low < grid_.counts[0]) look(row + low, row + low);
          if (high < grid_.counts[0] && high >= 0) look(row + high, row + high);
        }
      }
  }
  if (slot >= 0) best.index = grid_.order[slot];
  return best;
}

}  // namespace mortise::detail
