// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Lawrence and Colman's shape complementarity Sc: how well two surfaces fit each other.
#pragma once

#include <Eigen/Core>
#include <limits>

#include "mortise/molecules/molecule.hpp"

namespace mortise {

/// N radii for Sc, angstrom: united atoms of the AMBER force field (S. J. Weiner et al., J. Am.
/// Chem. Soc. 106 (1984) 765-784; R* of its atom types): CH3 2.00, CH2 1.925, CH and flat C 1.85,
/// N 1.75 (NZ of Lys 1.85), O 1.60, OH 1.65, S 2.00, P 2.10; outside amino acids C 1.90, N 1.75,
/// O 1.65, S 2.00, P 2.10; other elements element_radius(). docs/metrics.md has why not
/// atom_radii(). Hydrogens get what their element has: leave them out.
[[nodiscard]] Eigen::VectorXd complementarity_radii(const Molecule& molecule);

/// The defaults are the paper's: M. C. Lawrence, P. M. Colman, J. Mol. Biol. 234 (1993) 946-950.
struct ComplementarityOptions {
  double probe_radius = 1.7;  ///< of the molecular surface, length unit; > 0
  double density = 15.0;      ///< dots per unit of area; > 0
  double trim = 1.5;          ///< buried dots this close to an exposed one are left out; > 0
  double weight = 0.5;        ///< how fast S falls with the distance, per length unit squared; > 0
  int threads = 1;            ///< in making the surfaces; 0 = all cores; never changes the result
};

/// Sc and what it is the mean of. Without dots left after trimming all are NaN and the area is 0.
struct Complementarity {
  double sc = std::numeric_limits<double>::quiet_NaN();  ///< in [-1, 1]; 1: the surfaces coincide
  double fixed_to_moving = std::numeric_limits<double>::quiet_NaN();  ///< median of S over dots of
  double moving_to_fixed = std::numeric_limits<double>::quiet_NaN();  ///< the first named body
  double gap = std::numeric_limits<double>::quiet_NaN();  ///< median distance from a dot to the
                                                          ///< other surface, mean of both ways
  double area = 0.0;  ///< trimmed interface, mean of both bodies, length unit squared
};

/// Sc = ({S(A -> B)} + {S(B -> A)}) / 2, {} the median over the trimmed interface, with
///
///   S(A -> B)(x) = -(n(x) . n(x')) exp(-weight |x - x'|^2),
///
/// x' the nearest dot of B's trimmed interface and n outward normals. A dot is buried if the probe
/// that touches it runs into the other body. Buried dots within `trim` of an exposed dot of the
/// same body are left out. Dots count by the area they stand for.
///
/// @param fixed, moving  3 x N centres, both in one frame
/// @param fixed_radii, moving_radii  their radii, >= 0
/// @throws InputError as molecular_surface() and if an option is out of range
[[nodiscard]] Complementarity shape_complementarity(const Eigen::Matrix3Xd& fixed,
                                                    const Eigen::VectorXd& fixed_radii,
                                                    const Eigen::Matrix3Xd& moving,
                                                    const Eigen::VectorXd& moving_radii,
                                                    const ComplementarityOptions& options = {});

}  // namespace mortise
