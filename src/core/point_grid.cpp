// SPDX-License-Identifier: GPL-3.0-or-later
// Building the cell list.
#include "core/point_grid.hpp"

#include <algorithm>
#include <cmath>

namespace mortise::detail {
namespace {

// Steps to the nearest zero along one axis of the grid: with one such pass per axis, each on the
// last one's result, the largest-coordinate distance comes out. (max over axes: a cell reaches an
// occupied one in k steps if a cell within k along this axis reaches it in k along the others.)
void relax_axis(std::vector<std::uint8_t>& steps, std::int64_t count, std::int64_t stride,
                const std::int64_t (&counts)[3]) {
  const std::int64_t cells = counts[0] * counts[1] * counts[2];
  std::vector<std::uint8_t> line(static_cast<std::size_t>(count));
  for (std::int64_t start = 0; start < cells; ++start) {
    if ((start / stride) % count != 0) continue;
    for (std::int64_t i = 0; i < count; ++i) line[i] = steps[start + i * stride];
    for (std::int64_t i = 0; i < count; ++i) {
      std::int64_t best = line[i];
      for (std::int64_t k = 1; k < best; ++k) {
        std::int64_t other = 255;
        if (i >= k) other = line[i - k];
        if (i + k < count) other = std::min<std::int64_t>(other, line[i + k]);
        best = std::min(best, std::max(k, other));
      }
      steps[start + i * stride] = static_cast<std::uint8_t>(best);
    }
  }
}

}  // namespace

PointGrid::PointGrid(const Eigen::Matrix3Xd& points, double cutoff, double reach)
    : cutoff_sq_(cutoff * cutoff), edge_(cutoff) {
  if (points.cols() == 0) return;  // limits of zero: every position is outside
  const Eigen::Vector3d low = points.rowwise().minCoeff();
  const Eigen::Vector3d high = points.rowwise().maxCoeff();
  // Far-flung points must not cost memory: larger cells are slower, never wrong.
  constexpr double kMostCells = 4e6;
  double border = 0.0;
  for (;; edge_ *= 1.5) {
    border = std::floor(reach / edge_) + 2.0;
    limits_ = ((high - low).array() / edge_).floor() + 1.0 + 2.0 * border;
    if (limits_.prod() <= kMostCells) break;
  }
  inverse_edge_ = 1.0 / edge_;
  origin_ = low.array() - border * edge_;
  for (int d = 0; d < 3; ++d) counts_[d] = static_cast<std::int64_t>(limits_(d));
  const std::int64_t cells = counts_[0] * counts_[1] * counts_[2];

  std::vector<std::int64_t> cell_of_point(static_cast<std::size_t>(points.cols()));
  starts_.assign(static_cast<std::size_t>(cells) + 1, 0);
  steps_.assign(static_cast<std::size_t>(cells), 255);
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    cell_of_point[i] = cell_of(points.col(i));
    ++starts_[cell_of_point[i] + 1];
    steps_[cell_of_point[i]] = 0;
  }
  for (std::int64_t c = 0; c < cells; ++c) starts_[c + 1] += starts_[c];
  std::vector<std::int32_t> next(starts_.begin(), starts_.end() - 1);
  const auto size = static_cast<std::size_t>(points.cols());
  order_.resize(size);
  x_.resize(size);
  y_.resize(size);
  z_.resize(size);
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const std::int32_t slot = next[cell_of_point[i]]++;
    order_[slot] = static_cast<std::int32_t>(i);
    x_[slot] = points(0, i);
    y_[slot] = points(1, i);
    z_[slot] = points(2, i);
  }
  relax_axis(steps_, counts_[0], 1, counts_);
  relax_axis(steps_, counts_[1], counts_[0], counts_);
  relax_axis(steps_, counts_[2], counts_[0] * counts_[1], counts_);
}

}  // namespace mortise::detail
