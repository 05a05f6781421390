// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A score channel: one additive radial pair score between two sets of knots, as data.
#pragma once

#include <functional>
#include <string>

#include "mortise/core/knots.hpp"
#include "mortise/kernels/radial_transform.hpp"

namespace mortise {

/// One term of the score of a placement t of the moving body:
///
///   s(t) = weight Re sum_ij c_i d_j K_ij(|x_i - y_j - t|),   K^_ij(k) = fixed_transform(k, r_i)
///   moving_transform(k, r_j)
///
/// with x_i, r_i, c_i the fixed and y_j, r_j, d_j the moving knots. The second factor is not
/// conjugated, so that two imaginary (core) weights give a penalty: see [SD, Eq. 51-53] and
/// docs/math.md. Channels of one search are summed.
struct Channel {
  std::string name;
  double weight = 1.0;
  Knots fixed;                       ///< in the fixed body's input frame
  Knots moving;                      ///< in the moving body's input frame
  RadialTransform fixed_transform;   ///< the fixed body's field of one knot
  RadialTransform moving_transform;  ///< the moving body's
  double range =
      0.0;  ///< distance of two knots beyond which their score is nil; sizes the search's box
  /// K(d; r_i, r_j) of two knots in closed form, if there is one; only exact_scores()
  /// (scoring/shape_scores.hpp) asks it.
  std::function<double(double d, double fixed_radius, double moving_radius)> pair = {};
};

/// Throws InputError naming `who` unless both knot sets are good, both transforms are set, weight
/// and range are finite and the range is not negative.
void check_channel(const Channel& channel, const char* who);

}  // namespace mortise
