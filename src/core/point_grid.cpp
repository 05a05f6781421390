// SPDX-License-Identifier: GPL-3.0-or-later
// How far each cell is from points.
#include "core/point_grid.hpp"

#include <algorithm>

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
    if (std::all_of(line.begin(), line.end(), [](std::uint8_t s) { return s == 255; })) continue;
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
    : cutoff_sq_(cutoff * cutoff), grid_(points, cutoff, 2, reach) {
  const auto& counts = grid_.counts;
  steps_.resize(static_cast<std::size_t>(grid_.cells()));
  for (std::size_t c = 0; c < steps_.size(); ++c)
    steps_[c] = grid_.starts[c] == grid_.starts[c + 1] ? 255 : 0;
  relax_axis(steps_, counts[0], 1, counts);
  relax_axis(steps_, counts[1], counts[0], counts);
  relax_axis(steps_, counts[2], counts[0] * counts[1], counts);
}

}  // namespace mortise::detail
