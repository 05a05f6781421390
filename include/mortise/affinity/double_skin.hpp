// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The double-skin complex affinity: shape complementarity as a product of two fields.
#pragma once

#include "mortise/affinity/channel.hpp"

namespace mortise {

struct DoubleSkinOptions {
  double offset = 1.4;  ///< r0, thickness of the skin, length unit of the bodies; > 0
  double penalty =
      7.0;  ///< lambda, what the core weighs against the skin; >= 0. See docs/ranking.md
  /// Radius at which the penalty is as given; at others it goes as ((r + r0) / r)^3, so that core
  /// and skin of every ball have the same ratio. >= 0; 0 = one penalty for all radii.
  double penalty_radius = 0.0;
};

/// Transform of one ball's share of f_{S+B0} - lambda f_S, the double-skin affinity [SD, Eq. 51]
/// without its factor i: ball(k, r + r0) - lambda(r) ball(k, r). The offset is the lifted slice
/// (radii plus r0), not a convolution (docs/math.md).
[[nodiscard]] RadialTransform double_skin_transform(const DoubleSkinOptions& options = {});

/// The shape channel of two bodies. Weights of knots that are real w are taken as i w, so that
///
///   s = sum_ij w_i w_j [ -lambda^2 V(r_i, r_j) + lambda V(r_i + r0, r_j) + lambda V(r_i, r_j + r0)
///                        - V(r_i + r0, r_j + r0) ](d_ij),
///
/// V(a, b)(d) the common volume of two balls [SD, Eq. 53 with errata]: core on core costs, core on
/// skin pays, skin on skin costs a little.
///
/// @param fixed, moving  knots with real weights, each in its body's input frame
/// @throws InputError if a weight has an imaginary part, a set is bad or an option out of range
[[nodiscard]] Channel double_skin_channel(const Knots& fixed, const Knots& moving,
                                          const DoubleSkinOptions& options = {});

}  // namespace mortise
