// SPDX-License-Identifier: GPL-3.0-or-later
// Dots sorted into cells, to tell which of some dots are near any of the others.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace mortise::detail {

class DotCells {
 public:
  // points 3 x N, finite; distance > 0
  DotCells(const Eigen::Matrix3Xd& points, double distance);

  // Those of `chosen` with no dot outside `chosen` nearer than the distance; cell by cell.
  // @param chosen  different dots  @param points  the same as before
  [[nodiscard]] std::vector<std::int32_t> far_from_others(const std::vector<std::int32_t>& chosen,
                                                          const Eigen::Matrix3Xd& points) const;

 private:
  double distance_sq_;
  std::vector<std::int32_t> cell_of_;       // of each dot, among the occupied cells
  std::vector<std::int32_t> starts_;        // of each cell in order_; one more than cells
  std::vector<std::int32_t> order_;         // dots by cell
  std::vector<std::int32_t> first_around_;  // of each cell in around_; one more than cells
  std::vector<std::int32_t> around_;        // the occupied ones of its 27 cells
};

}  // namespace mortise::detail
