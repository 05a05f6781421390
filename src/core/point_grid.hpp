// SPDX-License-Identifier: GPL-3.0-or-later
// A cell list: the points within a cutoff of any position.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace mortise::detail {

// N points sorted into cubic cells whose edge is at least the cutoff. A border of empty cells
// around them lets positions up to `reach` away be asked without leaving the grid.
class PointGrid {
 public:
  // cutoff > 0, reach >= cutoff; points 3 x N, finite, may be empty
  PointGrid(const Eigen::Matrix3Xd& points, double cutoff, double reach);

  // True if no point can lie within `distance` <= reach of p. False tells nothing.
  [[nodiscard]] bool surely_farther(const Eigen::Vector3d& p, double distance) const {
    const std::int64_t cell = cell_of(p);
    // k cells to the nearest occupied one, by the largest coordinate: at least k - 1 whole edges
    // lie between.
    return cell < 0 || (static_cast<double>(steps_[cell]) - 1.0) * edge_ >= distance;
  }

  // Calls visit(index of the point) for all points at a distance below the cutoff from p.
  template <class Visit>
  void for_each_near(const Eigen::Vector3d& p, Visit&& visit) const {
    const std::int64_t cell = cell_of(p);
    if (cell < 0 || steps_[cell] > 1) return;  // so that the neighbours below exist
    for (std::int64_t z = -1; z <= 1; ++z)
      for (std::int64_t y = -1; y <= 1; ++y) {
        const std::int64_t row = cell + counts_[0] * (y + counts_[1] * z);
        for (std::int32_t k = starts_[row - 1]; k < starts_[row + 2]; ++k) {
          const double dx = x_[k] - p.x();
          const double dy = y_[k] - p.y();
          const double dz = z_[k] - p.z();
          if (dx * dx + dy * dy + dz * dz < cutoff_sq_) visit(order_[k]);
        }
      }
  }

 private:
  // Index of the cell of p; -1 outside the grid.
  [[nodiscard]] std::int64_t cell_of(const Eigen::Vector3d& p) const {
    const Eigen::Array3d u = (p - origin_).array() * inverse_edge_;
    if (!((u >= 0.0).all() && (u < limits_).all())) return -1;
    return static_cast<std::int64_t>(u.x()) +
           counts_[0] *
               (static_cast<std::int64_t>(u.y()) + counts_[1] * static_cast<std::int64_t>(u.z()));
  }

  double cutoff_sq_ = 0.0;
  double edge_ = 0.0;
  double inverse_edge_ = 0.0;
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
  Eigen::Array3d limits_ = Eigen::Array3d::Zero();  // cells along each axis
  std::int64_t counts_[3] = {0, 0, 0};
  std::vector<std::int32_t> starts_;  // of each cell in the sorted points; one more than cells
  std::vector<std::int32_t> order_;   // index of each sorted point
  std::vector<double> x_, y_, z_;     // sorted points
  std::vector<std::uint8_t>
      steps_;  // to the nearest occupied cell, largest coordinate; 255 = that or more
};

}  // namespace mortise::detail
