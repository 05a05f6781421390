// SPDX-License-Identifier: GPL-3.0-or-later
// The nearest of many points.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace mortise::detail {

// Points sorted into cubic cells, searched shell by shell of cells around the place asked for.
class NearestPoint {
 public:
  struct Found {
    std::int32_t index = -1;  // -1: none within the limit
    double distance_sq = 0.0;
  };

  // points 3 x N, finite; edge > 0, about the distance expected
  NearestPoint(const Eigen::Matrix3Xd& points, double edge);

  // The nearest point at a distance below `limit`, of equally near ones any.
  [[nodiscard]] Found operator()(const Eigen::Vector3d& p, double limit) const;

 private:
  double edge_;
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
  std::int64_t counts_[3] = {0, 0, 0};
  std::vector<std::int32_t> starts_;  // of each cell in the sorted points; one more than cells
  std::vector<std::int32_t> order_;   // index of each sorted point
  Eigen::Matrix3Xd sorted_;
};

}  // namespace mortise::detail
