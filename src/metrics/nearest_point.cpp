// SPDX-License-Identifier: GPL-3.0-or-later
// Nearest points by growing shells of cells.
#include "metrics/nearest_point.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace mortise::detail {

NearestPoint::NearestPoint(const Eigen::Matrix3Xd& points, double edge) : edge_(edge) {
  if (points.cols() == 0) return;
  origin_ = points.rowwise().minCoeff();
  const Eigen::Vector3d extent = points.rowwise().maxCoeff() - origin_;
  constexpr double kMostCells = 4e6;  // far-flung points: larger cells are slower, never wrong
  while (((extent / edge_).array().floor() + 1.0).prod() > kMostCells) edge_ *= 1.5;
  for (int d = 0; d < 3; ++d) counts_[d] = static_cast<std::int64_t>(extent[d] / edge_) + 1;
  const std::int64_t cells = counts_[0] * counts_[1] * counts_[2];
  starts_.assign(static_cast<std::size_t>(cells) + 1, 0);
  std::vector<std::int64_t> cell(static_cast<std::size_t>(points.cols()));
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const Eigen::Vector3d u = (points.col(i) - origin_) / edge_;
    cell[i] = static_cast<std::int64_t>(u.x()) +
              counts_[0] * (static_cast<std::int64_t>(u.y()) +
                            counts_[1] * static_cast<std::int64_t>(u.z()));
    ++starts_[cell[i] + 1];
  }
  for (std::int64_t c = 0; c < cells; ++c) starts_[c + 1] += starts_[c];
  std::vector<std::int32_t> next(starts_.begin(), starts_.end() - 1);
  order_.resize(cell.size());
  sorted_.resize(3, points.cols());
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const std::int32_t slot = next[cell[i]]++;
    order_[slot] = static_cast<std::int32_t>(i);
    sorted_.col(slot) = points.col(i);
  }
}

NearestPoint::Found NearestPoint::operator()(const Eigen::Vector3d& p, double limit) const {
  Found best{-1, limit * limit};
  if (order_.empty()) return best;
  const Eigen::Vector3d u = (p - origin_) / edge_;
  // A place outside the cells starts from the cell it would be in; no farther than needed.
  std::int64_t home[3], farthest = 0;
  double margin = 0.5;  // from p to the nearest wall of its cell, in cells
  for (int d = 0; d < 3; ++d) {
    const double floor = std::floor(std::clamp(u[d], -1e9, 1e9));
    margin = std::clamp(std::min(u[d] - floor, floor + 1.0 - u[d]), 0.0, margin);
    home[d] = static_cast<std::int64_t>(floor);
    farthest = std::max({farthest, home[d], counts_[d] - 1 - home[d]});
  }
  std::int32_t slot = -1;
  const auto look = [&](std::int64_t from, std::int64_t to) {  // cells of one row
    for (std::int32_t k = starts_[from]; k < starts_[to + 1]; ++k) {
      const double dx = sorted_(0, k) - p.x(), dy = sorted_(1, k) - p.y(),
                   dz = sorted_(2, k) - p.z();
      const double distance_sq = dx * dx + dy * dy + dz * dz;
      if (distance_sq < best.distance_sq) {
        best.distance_sq = distance_sq;
        slot = k;
      }
    }
  };
  for (std::int64_t shell = 0; shell <= farthest; ++shell) {
    // Whole cells lie between p and this shell.
    const double beyond = (static_cast<double>(shell - 1) + margin) * edge_;
    if (shell > 0 && beyond * beyond >= best.distance_sq) break;
    for (std::int64_t z = std::max<std::int64_t>(0, home[2] - shell);
         z <= std::min(counts_[2] - 1, home[2] + shell); ++z)
      for (std::int64_t y = std::max<std::int64_t>(0, home[1] - shell);
           y <= std::min(counts_[1] - 1, home[1] + shell); ++y) {
        const std::int64_t row = counts_[0] * (y + counts_[1] * z);
        const std::int64_t low = home[0] - shell, high = home[0] + shell;
        if (std::abs(y - home[1]) == shell || std::abs(z - home[2]) == shell) {
          const std::int64_t from = std::max<std::int64_t>(0, low),
                             to = std::min(counts_[0] - 1, high);
          if (from <= to) look(row + from, row + to);
        } else {
          if (low >= 0 && low < counts_[0]) look(row + low, row + low);
          if (high < counts_[0] && high >= 0) look(row + high, row + high);
        }
      }
  }
  if (slot >= 0) best.index = order_[slot];
  return best;
}

}  // namespace mortise::detail
