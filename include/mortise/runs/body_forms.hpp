// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Bodies of any kind as what a run needs of them: balls for docking, parts for mating.
#pragma once

#include <string>
#include <vector>

#include "mortise/core/knots.hpp"
#include "mortise/molecules/to_knots.hpp"
#include "mortise/parts/part.hpp"
#include "mortise/store/body.hpp"

namespace mortise {

/// Balls of a body: atoms as `options` say, balls as they are, a part taken apart by decompose()
/// with weights that share overlaps.
/// @param ball_grid  nodes along a part's longest side @throws as to_knots() and decompose()
[[nodiscard]] Knots body_knots(const Body& body, const ToKnotsOptions& options, int ball_grid);

/// A body as a part: itself, or the union of its balls with the surface that bounds it.
[[nodiscard]] Part body_part(const Body& body);

}  // namespace mortise
