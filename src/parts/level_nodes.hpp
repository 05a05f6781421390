// SPDX-License-Identifier: GPL-3.0-or-later
// The grid on which a surface in a box is triangulated.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include "mortise/core/errors.hpp"
#include "mortise/parts/distance_grid.hpp"

namespace mortise::parts {

// Nodes `spacing` apart (0: longest side / 128) that cover the box and a node's spacing around it.
// @throws InputError for a negative spacing or more than 2^28 nodes
inline GridNodes level_nodes(const Eigen::AlignedBox3d& box, double spacing, const char* who) {
  if (!(spacing >= 0.0) || !std::isfinite(spacing))
    throw InputError(std::string(who) + ": spacing must be >= 0, got " + std::to_string(spacing));
  const double longest = box.sizes().maxCoeff();
  const double step = spacing > 0.0 ? spacing : longest > 0.0 ? longest / 128.0 : 1.0;
  const Eigen::Array3d wanted = (box.sizes().array() / step).ceil() + 3.0;
  if (!(wanted.prod() <= std::pow(2.0, 28)))
    throw InputError(
        std::string(who) + ": a grid of more than 2^28 nodes; expected a spacing of at least " +
        std::to_string(longest / 645.0) + " for a box of longest side " + std::to_string(longest));
  GridNodes nodes;
  nodes.spacing = step;
  nodes.size = wanted.cast<int>();
  nodes.origin = box.center() - 0.5 * step * (nodes.size - 1).cast<double>().matrix();
  return nodes;
}

}  // namespace mortise::parts
