// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Parts as balls: the knots of mating's search by spherical decomposition.
#pragma once

#include "mortise/core/knots.hpp"
#include "mortise/parts/solid.hpp"
#include "scoring/local_part.hpp"

namespace mortise {

struct PartBallsOptions {
  double step = 0.02;  ///< of the decomposition's grid, unit of the solid; > 0
  double mu = 0.25;    ///< DecomposeOptions::protrusion
  double expansion =
      0.5;                ///< radii grow by this part of epsilon; half leaves the boundary in place
  double largest = 0.04;  ///< radius of a ball, at most, unit of the solid; > 0
  int threads = 0;
};

/// Balls of a solid in a local frame, set cover, weights that divide overlaps; carried to the input
/// frame. Balls no larger than `largest` keep the range of radii short: a search transforms the
/// moving body once for each term that the radii's factorisation needs (docs/math.md).
/// @param name  "fixed" or "moving", for errors
/// @throws InputError as decompose(), naming the part
[[nodiscard]] Knots part_balls(const char* name, const LocalFrame& frame, const Solid& solid,
                               const PartBallsOptions& options = {});

}  // namespace mortise
