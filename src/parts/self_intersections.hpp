// SPDX-License-Identifier: GPL-3.0-or-later
// Triangles that cross each other.
#pragma once

#include "parts/clean_soup.hpp"

namespace mortise::parts {

struct Crossings {
  long pairs = 0;
  bool more = false;                                ///< counting stopped
  Eigen::Vector3d first = Eigen::Vector3d::Zero();  ///< centre of a triangle of the first pair
};

/// Pairs of triangles without a common point that meet, and with one or two common points that meet
/// elsewhere too. Stops after `most` pairs.
[[nodiscard]] Crossings find_crossings(const Surface& surface, long most);

}  // namespace mortise::parts
