// SPDX-License-Identifier: GPL-3.0-or-later
// Real and imaginary parts of weights.
#include "search/real_products.hpp"

namespace mortise {

std::vector<RealProduct> real_products(const std::vector<Channel>& channels) {
  std::vector<RealProduct> result;
  for (const Channel& channel : channels) {
    if (channel.weight == 0.0) continue;
    const auto add = [&](const Eigen::VectorXd& fixed, const Eigen::VectorXd& moving, double sign) {
      if (!fixed.isZero(0.0) && !moving.isZero(0.0))
        result.push_back({&channel, fixed, moving, sign * channel.weight});
    };
    add(channel.fixed.weights.real(), channel.moving.weights.real(), 1.0);
    add(channel.fixed.weights.imag(), channel.moving.weights.imag(), -1.0);
  }
  return result;
}

}  // namespace mortise
