// SPDX-License-Identifier: GPL-3.0-or-later
// Holes: rings of open edges, filled where they are small.
#pragma once

#include "parts/clean_soup.hpp"

namespace mortise::parts {

struct Filled {
  long holes = 0;
  long triangles = 0;
  double largest = 0.0;  ///< extent of the largest one
};

/// Fills rings of open edges with triangles between their own points.
/// @param largest  extent (diagonal of its bounding box) of the largest hole that is filled
/// @param flat     holes of any extent are filled too if their points lie this near to one plane,
///                 length unit
Filled fill_holes(Surface& surface, const std::vector<OpenEdge>& open, double largest,
                  double flat = 0.0);

}  // namespace mortise::parts
