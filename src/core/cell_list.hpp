// SPDX-License-Identifier: GPL-3.0-or-later
// Points sorted into the occupied cells of an endless grid: work that goes cell by cell.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

namespace mortise::detail {

// Only occupied cells take memory, so that outliers cost nothing. All points within an edge of
// each other lie in cells around each other.
class CellList {
 public:
  // points 3 x N, finite; edge > 0, grown where the box has more than 10^6 of them a side
  CellList(const Eigen::Matrix3Xd& points, double edge);

  // Occupied cells, numbered along x first.
  [[nodiscard]] std::int32_t cells() const { return static_cast<std::int32_t>(starts_.size()) - 1; }
  [[nodiscard]] std::int32_t cell_of(Eigen::Index point) const { return cell_of_[point]; }
  // Points in a cell, rising.
  [[nodiscard]] std::span<const std::int32_t> points_in(std::int32_t cell) const {
    return {order_.data() + starts_[cell], order_.data() + starts_[cell + 1]};
  }
  // The occupied ones of a cell and its 26 neighbours, rising.
  [[nodiscard]] std::span<const std::int32_t> cells_around(std::int32_t cell) const {
    return {around_.data() + first_around_[cell], around_.data() + first_around_[cell + 1]};
  }

 private:
  std::vector<std::int32_t> cell_of_;       // of each point
  std::vector<std::int32_t> starts_;        // of each cell in order_; one more than cells
  std::vector<std::int32_t> order_;         // points by cell
  std::vector<std::int32_t> first_around_;  // of each cell in around_; one more than cells
  std::vector<std::int32_t> around_;
};

}  // namespace mortise::detail
