// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Walks through the triangle tree, compiled once per instruction set. Types only.
#pragma once

#include <cstddef>

#include "parts/triangle_tree.hpp"

namespace mortise {

struct TreeTable {
  /// For each of `count` points (x, y, z one after the other): the squared distance to the nearest
  /// triangle and which it is; `bound_sq` and -1 where none is nearer than that. Points next to
  /// each other in the list should be near each other in space.
  void (*nearest)(const TreeView& tree, const double* points, std::ptrdiff_t count, double bound_sq,
                  double* distance_sq, int* triangle);
  /// The winding number at each point; a child further than `beta` times its radius counts by its
  /// moments.
  void (*winding)(const TreeView& tree, const double* points, std::ptrdiff_t count, double beta,
                  double* winding);
};

/// The copy for this processor.
[[nodiscard]] const TreeTable& tree_table();

}  // namespace mortise
