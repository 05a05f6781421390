// SPDX-License-Identifier: GPL-3.0-or-later
// The search of neighbours, once per cell.
#include "metrics/dot_cells.hpp"

#include <algorithm>

namespace mortise::detail {

std::vector<std::int32_t> DotCells::far_from_others(const std::vector<std::int32_t>& chosen,
                                                    const Eigen::Matrix3Xd& points) const {
  std::vector<char> is_chosen(static_cast<std::size_t>(points.cols()), 0);
  std::vector<std::int32_t> cells;
  for (const std::int32_t dot : chosen) {
    is_chosen[dot] = 1;
    cells.push_back(cells_.cell_of(dot));
  }
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  std::vector<std::int32_t> out;
  std::vector<Eigen::Vector3d> others;
  for (const std::int32_t cell : cells) {
    others.clear();
    for (const std::int32_t around : cells_.cells_around(cell))
      for (const std::int32_t dot : cells_.points_in(around))
        if (is_chosen[dot] == 0) others.emplace_back(points.col(dot));
    for (const std::int32_t dot : cells_.points_in(cell)) {
      if (is_chosen[dot] == 0) continue;
      const double x = points(0, dot), y = points(1, dot), z = points(2, dot);
      const bool near = std::any_of(others.begin(), others.end(), [&](const Eigen::Vector3d& o) {
        return (o.x() - x) * (o.x() - x) + (o.y() - y) * (o.y() - y) + (o.z() - z) * (o.z() - z) <
               distance_sq_;
      });
      if (!near) out.push_back(dot);
    }
  }
  return out;
}

}  // namespace mortise::detail
