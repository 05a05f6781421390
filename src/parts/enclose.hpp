// SPDX-License-Identifier: GPL-3.0-or-later
// The solid that a surface encloses although its edges do not close.
#pragma once

#include "parts/clean_soup.hpp"

namespace mortise::parts {

/// What of a surface encloses a volume.
struct Enclosed {
  long turned = 0;         ///< triangles turned to face outward
  long sheets = 0;         ///< dropped: empty space on both sides
  long walls = 0;          ///< dropped: of the solid's inside on both sides
  bool wrapped = false;    ///< the faces do not close well enough: the surface is their wrap
  double deviation = 0.0;  ///< of a wrap: how far it lies from the faces, length unit
  double gap = 0.0;        ///< gaps up to this width count as closed, length unit
  double volume = 0.0;     ///< cubic units; > 0 unless no triangle is left
};

/// Leaves the surface as it is where its winding number tells the inside already. Otherwise keeps
/// the triangles of open patches that have the outside on one side and the inside on the other, and
/// turns them outward. Outside is where a ball can come from without touching a triangle, its
/// radius 1/30 of the diagonal, then 1/80 where that leaves doubts. Closed shells stay.
///
/// If the winding number still is not near a whole one at more than a twentieth of the surface, the
/// surface becomes its wrap. Nothing is left if the triangles enclose nothing.
/// @param surface  neighbours agree (agree_with_neighbours), closed shells face outward
[[nodiscard]] Enclosed enclose(Surface& surface);

}  // namespace mortise::parts
