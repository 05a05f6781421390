// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Channels taken apart into the real point sets that the search transforms.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "mortise/affinity/channel.hpp"
#include "mortise/core/rigid_motion.hpp"
#include "mortise/kernels/low_pass.hpp"
#include "search/frequencies.hpp"

namespace mortise {

/// One real weight per moving point and, for each offset, the fixed spectrum it meets.
struct Component {
  Eigen::VectorXf weights;            ///< of each point of Components::points
  std::vector<HalfSpectrum> spectra;  ///< per offset: fixed body's field times both kernels, the
                                      ///< low-pass and factors
};

struct Components {
  Eigen::Matrix3Xd points;  ///< 3 x N: the distinct moving centres of all channels, input frame
  std::vector<Component> parts;
};

struct ComponentOptions {
  double radius_tolerance = 3e-3;  ///< of the compressed radius (kernels/compressed_radius.hpp)
  LowPass low_pass = {};           ///< of the product; weighs the compression's errors, too
  std::vector<double> offsets = {0.0};  ///< added to the moving radii
  int threads = 0;
};

/// Every channel c gives up to two real products, Re Re and -Im Im of its weights, times as many
/// terms as its radii need. Fixed knots are carried by `search_from_fixed` first; the box is
/// periodic.
/// @param size, spacing  the grid whose frequencies are sampled
[[nodiscard]] Components make_components(const std::vector<Channel>& channels,
                                         const RigidMotion& search_from_fixed,
                                         const std::array<int, 3>& size, double spacing,
                                         const ComponentOptions& options);

}  // namespace mortise
