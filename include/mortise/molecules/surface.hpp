// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Solvent-accessible surface: which atoms are exposed.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "mortise/molecules/molecule.hpp"

namespace mortise {

struct SurfaceOptions {
  double probe_radius = 1.4;  ///< angstrom, >= 0; water
  /// >= 1; with 1000 an atom is good to 1% of its sphere, a residue of 50 A^2 or more to 2%
  int points_per_atom = 1000;
  int threads = 1;  ///< 0 = all cores; never changes the result
};

/// Area of each ball's sphere, grown by the probe, that lies in no other grown ball; N values,
/// length unit squared.
///
/// Shrake and Rupley, J. Mol. Biol. 79 (1973) 351-371, on the points of a Fibonacci lattice.
///
/// @param centres  3 x N
/// @param radii    N radii >= 0, without the probe
/// @throws InputError if the counts differ, a value is not finite, a radius is negative or an
/// option out of range. Time O(N points neighbours), memory O(N).
[[nodiscard]] Eigen::VectorXd accessible_areas(const Eigen::Matrix3Xd& centres,
                                               const Eigen::VectorXd& radii,
                                               const SurfaceOptions& options = {});

/// The same for a molecule's atoms with their atom_radii(), square angstrom.
[[nodiscard]] Eigen::VectorXd accessible_areas(const Molecule& molecule,
                                               const SurfaceOptions& options = {});

/// The points that accessible_areas() counts.
struct AccessiblePoints {
  Eigen::Matrix3Xd positions =
      Eigen::Matrix3Xd(3, 0);       ///< 3 x P: where a probe's centre can be, in touch with a ball
  std::vector<Eigen::Index> first;  ///< N + 1: those of ball i are columns first[i] to first[i + 1]
  Eigen::VectorXd areas;            ///< N: what each point of ball i stands for
};

/// The same points one by one, so that areas can be counted again when another body covers some.
/// @throws as accessible_areas(). Time and memory likewise, and 24 bytes a point.
[[nodiscard]] AccessiblePoints accessible_points(const Eigen::Matrix3Xd& centres,
                                                 const Eigen::VectorXd& radii,
                                                 const SurfaceOptions& options = {});

}  // namespace mortise
