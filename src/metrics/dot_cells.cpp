// SPDX-License-Identifier: GPL-3.0-or-later
// Cells of dots and the search of their neighbours, once per cell.
#include "metrics/dot_cells.hpp"

#include <algorithm>
#include <numeric>

namespace mortise::detail {

DotCells::DotCells(const Eigen::Matrix3Xd& points, double distance)
    : distance_sq_(distance * distance),
      cell_of_(static_cast<std::size_t>(points.cols())),
      order_(cell_of_.size()) {
  if (points.cols() == 0) return;
  const Eigen::Vector3d low = points.rowwise().minCoeff();
  const Eigen::Vector3d extent = points.rowwise().maxCoeff() - low;
  // Only occupied cells take memory; larger ones keep the keys within 64 bits.
  const double edge = std::max(distance, extent.maxCoeff() / 1e6);
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
      cells.push_back(keys[order_[k]]);
      starts_.push_back(static_cast<std::int32_t>(k));
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

std::vector<std::int32_t> DotCells::far_from_others(const std::vector<std::int32_t>& chosen,
                                                    const Eigen::Matrix3Xd& points) const {
  std::vector<char> is_chosen(cell_of_.size(), 0);
  std::vector<std::int32_t> cells;
  for (const std::int32_t dot : chosen) {
    is_chosen[dot] = 1;
    cells.push_back(cell_of_[dot]);
  }
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  std::vector<std::int32_t> out;
  std::vector<Eigen::Vector3d> others;
  for (const std::int32_t cell : cells) {
    others.clear();
    for (std::int32_t a = first_around_[cell]; a < first_around_[cell + 1]; ++a)
      for (std::int32_t k = starts_[around_[a]]; k < starts_[around_[a] + 1]; ++k)
        if (is_chosen[order_[k]] == 0) others.emplace_back(points.col(order_[k]));
    for (std::int32_t k = starts_[cell]; k < starts_[cell + 1]; ++k) {
      const std::int32_t dot = order_[k];
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
