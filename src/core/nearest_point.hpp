// SPDX-License-Identifier: GPL-3.0-or-later
// The nearest of many points.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "core/cell_grid.hpp"

namespace mortise::detail {

// Searched shell by shell of cells around the place asked for.
class NearestPoint {
 public:
  struct Found {
    std::int32_t index = -1;  // -1: none within the limit
    double distance_sq = 0.0;
  };

  // points 3 x N, finite; edge > 0, about the distance expected
  NearestPoint(const Eigen::Matrix3Xd& points, double edge) : grid_(points, edge, 0, 0.0) {}

  // The nearest point at a distance below `limit`, of equally near ones any.
  [[nodiscard]] Found operator()(const Eigen::Vector3d& p, double limit) const;

 private:
  CellGrid grid_;
};

}  // namespace mortise::detail
