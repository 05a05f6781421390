// SPDX-License-Identifier: GPL-3.0-or-later
// Distance grids of parts.
#include "scoring/distance_field.hpp"

#include <cmath>

#include "mortise/parts/distance_grid.hpp"

namespace mortise {

DistanceField::DistanceField(const Solid& solid, double spacing, double margin, int threads)
    : spacing_(spacing), inverse_(static_cast<float>(1.0 / spacing)) {
  const Eigen::AlignedBox3d box = solid.bounds();
  GridNodes nodes;
  nodes.origin = box.min().array() - margin;
  nodes.spacing = spacing;
  for (int d = 0; d < 3; ++d) {
    const auto axis = static_cast<std::size_t>(d);
    size_[axis] = static_cast<int>(std::ceil((box.sizes()[d] + 2.0 * margin) / spacing)) + 2;
    last_[axis] = static_cast<float>(size_[axis] - 1);
    nodes.size[d] = size_[axis];
  }
  low_ = nodes.origin.cast<float>();
  step_x_ = static_cast<std::ptrdiff_t>(size_[1]) * size_[2];
  // Beyond the margin a placement is judged by the sign alone.
  values_ = distance_grid(solid, nodes, {.band = margin, .threads = threads}).values;
}

Eigen::Vector3d DistanceField::high() const {
  return low() + spacing_ * Eigen::Vector3d(size_[0] - 1, size_[1] - 1, size_[2] - 1);
}

}  // namespace mortise
