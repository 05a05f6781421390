// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A body between two unions of balls: what collision answers are certain about.
#pragma once

#include "mortise/core/knots.hpp"
#include "mortise/parts/solid.hpp"

namespace mortise {

/// The balls lie in the body, and grown by `cover` they hold it. Weights are not used. cover = 0:
/// the body is the balls, and answers are exact.
struct CollisionBody {
  Knots balls;
  double cover = 0.0;  ///< length unit; >= 0
};

struct CollisionBodyOptions {
  int grid = 64;    ///< nodes along the longest side; finer means a smaller cover
  int threads = 0;  ///< 0 = all cores; never changes the result
};

/// The spherical decomposition of a solid, each ball cut back to the distance of its centre from
/// the boundary; the cover is what that takes off plus the decomposition's own epsilon [SD, Prop.
/// 3], two epsilon at most.
/// @throws InputError if an option is out of range or no ball lies in the solid
[[nodiscard]] CollisionBody collision_body(const Solid& solid,
                                           const CollisionBodyOptions& options = {});

}  // namespace mortise
