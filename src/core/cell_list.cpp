// SPDX-License-Identifier: GPL-3.0-or-later
// Sorting by the cells' keys.
#include "core/cell_list.hpp"

#include <algorithm>
#include <numeric>

namespace mortise::detail {

CellList::CellList(const Eigen::Matrix3Xd& points, double smallest_edge)
    : cell_of_(static_cast<std::size_t>(points.cols())), order_(cell_of_.size()) {
  starts_.push_back(0);
  if (points.cols() == 0) return;
  const Eigen::Vector3d low = points.rowwise().minCoeff();
  const Eigen::Vector3d extent = points.rowwise().maxCoeff() - low;
  const double edge = std::max(smallest_edge, extent.maxCoeff() / 1e6);  // keys fit into 64 bits
  std::int64_t sizes[3];
  for (int d = 0; d < 3; ++d)
    sizes[d] = static_cast<std::int64_t>(extent[d] / edge) + 3;  // a rim of empty cells
  const auto key = [&](std::int64_t x, std::int64_t y, std::int64_t z) {
    return (z * sizes[1] + y) * sizes[0] + x;
  };
  std::vector<std::int64_t> keys(cell_of_.size());
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const Eigen::Vector3d u = (points.col(i) - low) / edge;
    keys[i] = key(static_cast<std::int64_t>(u.x()) + 1, static_cast<std::int64_t>(u.y()) + 1,
                  static_cast<std::int64_t>(u.z()) + 1);
  }
  std::iota(order_.begin(), order_.end(), 0);
  std::sort(order_.begin(), order_.end(), [&](std::int32_t a, std::int32_t b) {
    return keys[a] != keys[b] ? keys[a] < keys[b] : a < b;
  });
  std::vector<std::int64_t> cells;  // keys, rising
  for (std::size_t k = 0; k < order_.size(); ++k) {
    if (cells.empty() || cells.back() != keys[order_[k]]) {
      if (k > 0) starts_.push_back(static_cast<std::int32_t>(k));
      cells.push_back(keys[order_[k]]);
    }
    cell_of_[order_[k]] = static_cast<std::int32_t>(cells.size()) - 1;
  }
  starts_.push_back(static_cast<std::int32_t>(order_.size()));
  for (const std::int64_t cell : cells) {
    first_around_.push_back(static_cast<std::int32_t>(around_.size()));
    for (std::int64_t z = -1; z <= 1; ++z)
      for (std::int64_t y = -1; y <= 1; ++y) {
        const std::int64_t row = cell + key(0, y, z);
        auto it = std::lower_bound(cells.begin(), cells.end(), row - 1);
        for (; it != cells.end() && *it <= row + 1; ++it)
          around_.push_back(static_cast<std::int32_t>(it - cells.begin()));
      }
  }
  first_around_.push_back(static_cast<std::int32_t>(around_.size()));
}

}  // namespace mortise::detail
