// SPDX-License-Identifier: GPL-3.0-or-later
// Points sorted into the cubic cells of a box, empty ones included: what searches around any place
// stand on.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace mortise::detail {

// For points that stay and fill their box. Where only the occupied cells should take memory, see
// CellList; where points come one by one, CellHash.
struct CellGrid {
  // Cells of this edge over the points' box and, beyond it, `border` of empty ones on each side,
  // at least so many that places up to `reach` away lie in a cell. Larger cells than asked for
  // where there would be more than 4 million: far-flung points must not cost memory.
  // points 3 x N, finite, may be empty; edge > 0
  CellGrid(const Eigen::Matrix3Xd& points, double smallest_edge, std::int64_t border, double reach);

  // In cells from the grid's corner.
  [[nodiscard]] Eigen::Array3d place(const Eigen::Vector3d& p) const {
    return (p - origin).array() * inverse_edge;
  }
  [[nodiscard]] std::int64_t cell(std::int64_t i, std::int64_t j, std::int64_t k) const {
    return i + counts[0] * (j + counts[1] * k);
  }
  // Index of the cell of p; -1 outside the grid.
  [[nodiscard]] std::int64_t cell_of(const Eigen::Vector3d& p) const {
    const Eigen::Array3d u = place(p);
    if (!((u >= 0.0).all() && (u < limits).all())) return -1;
    return cell(static_cast<std::int64_t>(u.x()), static_cast<std::int64_t>(u.y()),
                static_cast<std::int64_t>(u.z()));
  }
  [[nodiscard]] std::int64_t cells() const { return counts[0] * counts[1] * counts[2]; }

  double edge = 0.0;
  double inverse_edge = 0.0;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  std::int64_t counts[3] = {0, 0, 0};              // cells along each axis; none without points
  Eigen::Array3d limits = Eigen::Array3d::Zero();  // the same
  std::vector<std::int32_t> starts;                // of each cell in the sorted points, and the end
  std::vector<std::int32_t> order;                 // index of each sorted point; rising in a cell
  std::vector<double> x, y, z;                     // sorted points
};

}  // namespace mortise::detail
