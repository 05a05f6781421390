// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// How well a set of rotations covers SO(3).
#pragma once

#include <Eigen/Core>

namespace mortise {

/// Figures of one rotation set; angles are rotation angles in radians.
struct Coverage {
  double covering_radius = 0.0;  ///< largest angle from any rotation to its nearest in the set
  Eigen::Vector4d farthest =
      Eigen::Vector4d::Zero();  ///< a rotation that far away: w, x, y, z, canonical
  double mean_distance = 0.0;   ///< mean angle from a uniformly random rotation to its nearest
  double separation = 0.0;      ///< smallest angle between two members; pi for a single one
  double smallest_cell = 0.0;   ///< least volume of a Voronoi cell, in units of the mean one
  double largest_cell = 0.0;    ///< greatest volume of a Voronoi cell, in units of the mean one
  double volume_error =
      0.0;  ///< |sum of cell volumes / volume of SO(3) - 1|: the accuracy of the means
};

/// The covering radius alone, radians.
///
/// Each member's Voronoi cell is clipped exactly. Under the gnomonic projection about the member,
/// x = (q + F y) / |q + F y| with y in R^3, a cell is a convex polyhedron, and its farthest points
/// are vertices.
///
/// @param quaternions  4 x N: rows w, x, y, z, unit length; no two the same rotation
/// @param threads      0 = all cores; never changes the result
/// @throws InputError if there is no column or one is not of unit length
/// Accurate to about 1e-9 rad. Exactly pi if a cell reaches rotations by pi. Time O(N log N).
[[nodiscard]] double covering_radius(const Eigen::Matrix4Xd& quaternions, int threads = 0);

/// All figures; the means are integrals over the same cells, by quadrature (see volume_error), not
/// by sampling.
[[nodiscard]] Coverage measure_coverage(const Eigen::Matrix4Xd& quaternions, int threads = 0);

}  // namespace mortise
