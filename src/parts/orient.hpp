// SPDX-License-Identifier: GPL-3.0-or-later
// Turning triangles the same way and shells outward.
#pragma once

#include "parts/clean_soup.hpp"

namespace mortise::parts {

struct Turned {
  long triangles = 0;      ///< turned over to agree with their neighbours
  long one_sided = 0;      ///< edges at which no choice agrees: a one-sided surface
  long first_corner = -1;  ///< a point of the first such edge
};

/// Makes neighbours across edges of exactly two triangles agree, turning as few triangles of each
/// patch as possible.
Turned agree_with_neighbours(Surface& surface, const std::vector<Side>& sides);

struct Outward {
  long shells = 0;  ///< connected closed shells
  long turned = 0;  ///< of them, turned inside out
  long flat = 0;    ///< dropped for having no volume
  double volume = 0.0;
};

/// Turns every closed shell that no other shell holds outward, together with the shells it holds.
/// Open patches are left as they are.
Outward turn_outward(Surface& surface, const std::vector<Side>& sides);

}  // namespace mortise::parts
