// SPDX-License-Identifier: GPL-3.0-or-later
// The grid of a decomposition.
#include "parts/node_field.hpp"

#include <string>

#include "mortise/core/errors.hpp"

namespace mortise::parts {

GridNodes cell_centers(const Eigen::AlignedBox3d& box, int grid) {
  const double longest = box.isEmpty() ? 0.0 : box.sizes().maxCoeff();
  if (!(longest > 0.0) || !std::isfinite(longest) || !box.center().allFinite())
    throw InputError(
        "decompose: a solid whose box is finite and not empty expected, longest side " +
        std::to_string(longest));
  GridNodes nodes;
  nodes.spacing = longest / grid;
  // A side that is a whole number of cells long but for rounding gets no further cell.
  nodes.size = (box.sizes().array() / nodes.spacing - 1e-9).ceil().cast<int>().max(1);
  nodes.origin = box.center() - 0.5 * nodes.spacing * (nodes.size - 1).cast<double>().matrix();
  return nodes;
}

NodeField node_field(const DistanceGrid& grid) {
  NodeField field;
  static_cast<GridNodes&>(field) = grid;
  field.depth.resize(grid.values.size());
  for (std::size_t i = 0; i < grid.values.size(); ++i) {
    if (!std::isfinite(grid.values[i]))
      throw InputError("decompose: the distance at node " + std::to_string(i) + " is not finite");
    field.depth[i] = static_cast<float>(-grid.values[i] / grid.spacing);
  }
  return field;
}

}  // namespace mortise::parts
