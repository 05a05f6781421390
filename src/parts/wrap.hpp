// SPDX-License-Identifier: GPL-3.0-or-later
// A closed surface around triangles that need not be one.
#pragma once

#include "parts/clean_soup.hpp"

namespace mortise::parts {

/// The closed surface that a ball of radius `alpha` finds when it comes from outside and stops at
/// `offset` from the triangles [Portaneri et al., ACM Trans. Graph. 41 (2022), 127; CGAL's
/// alpha_wrap_3]. Gaps, slots and cavities that the ball cannot enter are closed. It faces outward.
/// @param alpha, offset  > 0, length unit of the surface
[[nodiscard]] TriangleMesh wrap(const Surface& surface, double alpha, double offset);

}  // namespace mortise::parts
