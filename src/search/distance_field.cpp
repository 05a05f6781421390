// SPDX-License-Identifier: GPL-3.0-or-later
// Distance grids of parts.
#include "search/distance_field.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mortise/core/threads.hpp"

namespace mortise {

DistanceField::DistanceField(const Solid& solid, double spacing, double margin, int threads)
    : spacing_(spacing), inverse_(static_cast<float>(1.0 / spacing)) {
  Eigen::AlignedBox3d box = solid.bounds();
  const Eigen::Vector3d low = box.min().array() - margin;
  low_ = low.cast<float>();
  for (int d = 0; d < 3; ++d) {
    const auto axis = static_cast<std::size_t>(d);
    size_[axis] = static_cast<int>(std::ceil((box.sizes()[d] + 2.0 * margin) / spacing)) + 2;
    last_[axis] = static_cast<float>(size_[axis] - 1);
  }
  step_x_ = static_cast<std::ptrdiff_t>(size_[1]) * size_[2];
  values_.resize(static_cast<std::size_t>(size_[0]) * static_cast<std::size_t>(step_x_));
  parallel_for(static_cast<std::size_t>(size_[0]), threads, [&](std::size_t i, int) {
    Eigen::Matrix3Xd nodes(3, step_x_);
    for (std::ptrdiff_t n = 0; n < step_x_; ++n)
      nodes.col(n) =
          low + spacing * Eigen::Vector3d(static_cast<double>(i), static_cast<double>(n / size_[2]),
                                          static_cast<double>(n % size_[2]));
    const Eigen::VectorXd distance =
        solid.signed_distance(nodes, std::numeric_limits<double>::infinity());
    std::transform(distance.begin(), distance.end(),
                   values_.begin() + static_cast<std::ptrdiff_t>(i) * step_x_,
                   [](double d) { return static_cast<float>(d); });
  });
}

Eigen::Vector3d DistanceField::high() const {
  return low() + spacing_ * Eigen::Vector3d(size_[0] - 1, size_[1] - 1, size_[2] - 1);
}

}  // namespace mortise
