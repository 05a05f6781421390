// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Channels taken apart into products of real weights.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "mortise/affinity/channel.hpp"

namespace mortise {

/// One of the two terms of Re(c d) = Re c Re d - Im c Im d.
struct RealProduct {
  const Channel* channel;
  Eigen::VectorXd fixed, moving;  ///< weights of the channel's knots
  double factor;                  ///< the channel's weight with the term's sign
};

/// The terms that are not zero. @param channels  must outlive the result
[[nodiscard]] std::vector<RealProduct> real_products(const std::vector<Channel>& channels);

}  // namespace mortise
