// SPDX-License-Identifier: GPL-3.0-or-later
// Sorting by counting.
#include "core/cell_grid.hpp"

#include <algorithm>
#include <cmath>

namespace mortise::detail {

CellGrid::CellGrid(const Eigen::Matrix3Xd& points, double smallest_edge, std::int64_t border,
                   double reach)
    : edge(smallest_edge) {
  if (points.cols() == 0) return;  // limits of zero: every position is outside
  const Eigen::Vector3d low = points.rowwise().minCoeff();
  const Eigen::Vector3d extent = points.rowwise().maxCoeff() - low;
  constexpr double kMostCells = 4e6;
  double empty = 0.0;
  for (;; edge *= 1.5) {
    empty = std::floor(reach / edge) + static_cast<double>(border);
    limits = (extent.array() / edge).floor() + 1.0 + 2.0 * empty;
    if (limits.prod() <= kMostCells) break;
  }
  inverse_edge = 1.0 / edge;
  origin = low.array() - empty * edge;
  for (int d = 0; d < 3; ++d) counts[d] = static_cast<std::int64_t>(limits(d));

  const auto size = static_cast<std::size_t>(points.cols());
  std::vector<std::int64_t> cell_of_point(size);
  starts.assign(static_cast<std::size_t>(cells()) + 1, 0);
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    // The farthest point may round to the border itself.
    const Eigen::Array3d u = place(points.col(i)).min(limits - 1.0);
    cell_of_point[i] = cell(static_cast<std::int64_t>(u.x()), static_cast<std::int64_t>(u.y()),
                            static_cast<std::int64_t>(u.z()));
    ++starts[cell_of_point[i] + 1];
  }
  for (std::int64_t c = 0; c < cells(); ++c) starts[c + 1] += starts[c];
  std::vector<std::int32_t> next(starts.begin(), starts.end() - 1);
  order.resize(size);
  x.resize(size);
  y.resize(size);
  z.resize(size);
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const std::int32_t slot = next[cell_of_point[i]]++;
    order[slot] = static_cast<std::int32_t>(i);
    x[slot] = points(0, i);
    y[slot] = points(1, i);
    z[slot] = points(2, i);
  }
}

}  // namespace mortise::detail
