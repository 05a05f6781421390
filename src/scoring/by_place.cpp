// SPDX-License-Identifier: GPL-3.0-or-later
// Poses along a curve through space.
#include "scoring/by_place.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace mortise::detail {

std::vector<std::size_t> by_place(const std::vector<RigidMotion>& poses,
                                  const Eigen::Vector3d& centre) {
  constexpr int kBits = 8;  // an axis: cells of one or two grid steps
  Eigen::Matrix3Xd places(3, static_cast<Eigen::Index>(poses.size()));
  for (std::size_t i = 0; i < poses.size(); ++i)
    places.col(static_cast<Eigen::Index>(i)) = poses[i] * centre;
  std::vector<std::pair<std::uint32_t, std::size_t>> keys(poses.size());
  if (poses.empty()) return {};
  const Eigen::Vector3d low = places.rowwise().minCoeff();
  const double extent = (places.rowwise().maxCoeff() - low).maxCoeff();
  const double scale = extent > 0.0 ? ((1 << kBits) - 1) / extent : 0.0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    std::uint32_t key = 0;
    for (int d = 0; d < 3; ++d) {
      const double at = (places(d, static_cast<Eigen::Index>(i)) - low[d]) * scale;
      const auto cell = static_cast<std::uint32_t>(at >= 0.0 ? at : 0.0);  // NaN too
      for (int b = 0; b < kBits; ++b) key |= (cell >> b & 1U) << (3 * b + d);
    }
    keys[i] = {key, i};
  }
  std::sort(keys.begin(), keys.end());
  std::vector<std::size_t> order(poses.size());
  std::transform(keys.begin(), keys.end(), order.begin(), [](const auto& k) { return k.second; });
  return order;
}

}  // namespace mortise::detail
