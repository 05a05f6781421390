// SPDX-License-Identifier: GPL-3.0-or-later
// Which of some dots are near any of the others.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/cell_list.hpp"

namespace mortise::detail {

class DotCells {
 public:
  // points 3 x N, finite; distance > 0
  DotCells(const Eigen::Matrix3Xd& points, double distance)
      : distance_sq_(distance * distance), cells_(points, distance) {}

  // Those of `chosen` with no dot outside `chosen` nearer than the distance; cell by cell.
  // @param chosen  different dots  @param points  the same as before
  [[nodiscard]] std::vector<std::int32_t> far_from_others(const std::vector<std::int32_t>& chosen,
                                                          const Eigen::Matrix3Xd& points) const;

 private:
  double distance_sq_;
  CellList cells_;
};

}  // namespace mortise::detail
