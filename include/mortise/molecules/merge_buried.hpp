// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Buried balls merged into fewer, larger ones: what knots have radii for.
#pragma once

#include "mortise/core/knots.hpp"

namespace mortise {

struct MergeBuriedOptions {
  double largest = 4.0;  ///< radius of a merged ball, at most, length unit; > 0
  double probe = 1.4;    ///< of the probe that rolls over the balls, length unit; >= 0
  double offset = 1.4;   ///< r0: merged weights keep sum_i w_i (r_i + r0)^3; >= 0
  int least = 4;         ///< balls that a merged one stands for, at least; >= 2
  int threads = 1;       ///< 0 = all cores; never changes the result
};

/// Replaces balls deep inside by larger ones, greedily: of the balls about the centres of the given
/// ones, as large as the solvent-excluded volume and `largest` allow, the one that contains most
/// balls not merged yet takes these in, again and again until none contains `least`. What is left
/// keeps its place and order; merged balls follow.
///
/// No merged ball leaves the solvent-excluded volume of the balls (the depth below their accessible
/// surface, known at 200 points a ball, is at least its radius plus the probe's): the surface is
/// as it was. The weight of a merged ball is sum w_i ((r_i + r0) / (R + r0))^3 over what it took
/// in, so that the integrals of the double skin and of its core are kept where the penalty goes as
/// ((r + r0) / r)^3 (DoubleSkinOptions::penalty_radius).
/// @throws InputError if the knots are bad or an option is out of range
/// Time O(N (points and balls near by)) and O(N) per merged ball.
[[nodiscard]] Knots merge_buried(const Knots& knots, const MergeBuriedOptions& options = {});

}  // namespace mortise
