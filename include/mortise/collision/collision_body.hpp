// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A body between two unions of balls: what collision answers are certain about.
#pragma once

#include "mortise/collision/body_density.hpp"
#include "mortise/core/knots.hpp"
#include "mortise/parts/solid.hpp"

namespace mortise {

/// The balls hold the body; no point of them is farther than `margin` from it; those larger than
/// `margin`, cut back by it, lie in the body. Weights are not used. margin = 0: the body is the
/// balls, and answers are exact.
struct CollisionBody {
  Knots balls;
  double margin = 0.0;                  ///< length unit; >= 0
  BodyDensity density = BodyDensity();  ///< what gap values are made of; empty: the balls, 1 each
};

struct CollisionBodyOptions {
  int grid = 64;           ///< nodes along the longest side; finer means a smaller margin
  double deviation = 0.0;  ///< the solid's boundary may be off the true one by this, length unit;
                           ///< >= 0, as ReadPartResult::deviation
  int threads = 0;         ///< 0 = all cores; never changes the result
};

/// The spherical decomposition of a solid with the centres' exact distances s from the boundary,
/// negative outside: radii are s + c, c such that the balls hold the solid. c is not taken from the
/// decomposition's bound but found, to 1/8 of a cell's half diagonal, as an upper bound on the
/// largest min_i |p - x_i| - s_i over the solid's points p, by dividing cells (docs/math.md). The
/// margin is c plus twice the deviation. The density is each cell's share in the solid, by its
/// node's distance.
/// @throws InputError if an option is out of range or no node lies in the solid
[[nodiscard]] CollisionBody collision_body(const Solid& solid,
                                           const CollisionBodyOptions& options = {});

}  // namespace mortise
