// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Channels taken apart into the real point sets that the search transforms.
#pragma once

#include <Eigen/Core>
#include <array>
#include <complex>
#include <vector>

#include "mortise/affinity/channel.hpp"
#include "mortise/core/rigid_motion.hpp"

namespace mortise {

/// One real weight per moving point and the fixed spectrum it meets.
struct Component {
  Eigen::VectorXf weights;  ///< of each point of Components::points
  /// Fixed body's field times both kernels, sampled at integer frequencies: kx, ky from
  /// -floor(n/2), kz from 0; kz fastest.
  std::vector<std::complex<double>> spectrum;
};

struct Components {
  Eigen::Matrix3Xd points;  ///< 3 x N: the distinct moving centres of all channels, input frame
  std::vector<Component> parts;
};

/// Every channel c gives up to two real products, Re Re and -Im Im of its weights, times as many
/// terms as its radii need. Fixed knots are carried by `search_from_fixed` first; the box is
/// periodic.
/// @param size, spacing  the grid whose frequencies are sampled
[[nodiscard]] Components make_components(const std::vector<Channel>& channels,
                                         const RigidMotion& search_from_fixed,
                                         const std::array<int, 3>& size, double spacing,
                                         int threads);

}  // namespace mortise
