// SPDX-License-Identifier: GPL-3.0-or-later
// The points within a cutoff of any position.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/cell_grid.hpp"

namespace mortise::detail {

// N points in cells whose edge is at least the cutoff. A border of empty cells around them lets
// positions up to `reach` away be asked without leaving the grid.
class PointGrid {
 public:
  // cutoff > 0, reach >= cutoff; points 3 x N, finite, may be empty
  PointGrid(const Eigen::Matrix3Xd& points, double cutoff, double reach);

  // True if no point can lie within `distance` <= reach of p. False tells nothing.
  [[nodiscard]] bool surely_farther(const Eigen::Vector3d& p, double distance) const {
    const std::int64_t cell = grid_.cell_of(p);
    // k cells to the nearest occupied one, by the largest coordinate: at least k - 1 whole edges
    // lie between.
    return cell < 0 || (static_cast<double>(steps_[cell]) - 1.0) * grid_.edge >= distance;
  }

  // Calls visit(index of the point) for all points at a distance below the cutoff from p.
  template <class Visit>
  void for_each_near(const Eigen::Vector3d& p, Visit&& visit) const {
    const std::int64_t cell = grid_.cell_of(p);
    if (cell < 0 || steps_[cell] > 1) return;  // so that the neighbours below exist
    for (std::int64_t z = -1; z <= 1; ++z)
      for (std::int64_t y = -1; y <= 1; ++y) {
        const std::int64_t row = cell + grid_.cell(0, y, z);
        for (std::int32_t k = grid_.starts[row - 1]; k < grid_.starts[row + 2]; ++k) {
          const double dx = grid_.x[k] - p.x();
          const double dy = grid_.y[k] - p.y();
          const double dz = grid_.z[k] - p.z();
          if (dx * dx + dy * dy + dz * dz < cutoff_sq_) visit(grid_.order[k]);
        }
      }
  }

 private:
  double cutoff_sq_;
  CellGrid grid_;
  std::vector<std::uint8_t>
      steps_;  // to the nearest occupied cell, largest coordinate; 255 = that or more
};

}  // namespace mortise::detail
