// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Van der Waals radii of heavy atoms that stand for their hydrogens too.
#pragma once

#include <Eigen/Core>
#include <string>

#include "mortise/molecules/molecule.hpp"

namespace mortise {

/// Radius of one atom, angstrom.
///
/// Amino acids: united-atom radii by residue and atom name, the ProtOr set of Tsai, Taylor, Chothia
/// and Gerstein, J. Mol. Biol. 290 (1999) 253-266, Table 2: by hybridisation and number of
/// hydrogens. Everything else, nucleotides included, and atoms the table does not know:
/// element_radius().
[[nodiscard]] double atom_radius(const Atom& atom);

/// Radius by element symbol ("C", "Zn"), angstrom: Bondi, J. Phys. Chem. 68 (1964) 441-451; main
/// group elements that are not there: Mantina et al., J. Phys. Chem. A 113 (2009) 5806-5812; any
/// other: 2.0.
[[nodiscard]] double element_radius(const std::string& element);

/// N radii, one per atom, angstrom.
[[nodiscard]] Eigen::VectorXd atom_radii(const Molecule& molecule);

/// 3 x N positions, angstrom.
[[nodiscard]] Eigen::Matrix3Xd atom_positions(const Molecule& molecule);

/// 4 x N balls: position and radius, angstrom.
[[nodiscard]] Eigen::Matrix4Xd atom_balls(const Molecule& molecule);

}  // namespace mortise
