// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What a pair of knots adds to the shape score, by their distance.
#pragma once

#include <vector>

#include "mortise/affinity/channel.hpp"
#include "mortise/kernels/low_pass.hpp"

namespace mortise {

/// A function of distance that is 0 from `range` on, as a table over the squared distance.
struct TabulatedKernel {
  double range = 0.0;          ///< length unit of the bodies; > 0
  std::vector<double> values;  ///< at squared distances i range^2 / (n - 1), i < n; n >= 2

  /// Linear in the squared distance between entries. @param d_sq  >= 0
  [[nodiscard]] double operator()(double d_sq) const;
};

/// Score of two knots of a channel with weights 1 and given radii, low-passed:
///
///   K(d) = weight Int fixed_transform(k, r) moving_transform(k, r') low_pass(k) exp(2 pi i k.d)
///   d^3k
///
/// so that the channel scores Re sum_ij c_i d_j K(d_ij). K is cut 1.15 / cutoff past the channel's
/// range, tapered over the last 0.5 / cutoff: little of it reaches there (docs/math.md).
/// @throws InputError unless the low-pass ends at a finite cutoff > 0 and radii are > 0
[[nodiscard]] TabulatedKernel shape_kernel(const Channel& channel, double fixed_radius,
                                           double moving_radius, const LowPass& low_pass);

}  // namespace mortise
