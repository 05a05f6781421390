// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Writing molecules, moved or not, in the PDB and PDBx/mmCIF formats.
#pragma once

#include <string>

#include "mortise/core/rigid_motion.hpp"
#include "mortise/molecules/molecule.hpp"

namespace mortise {

struct FormatPdbOptions {
  int first_serial = 1;  ///< serial number of the first atom; hybrid-36 from 100,000 on
};

/// ATOM, HETATM and TER records of a molecule moved by `motion`; one line each, no MODEL and no END
/// record. Residue numbers beyond 9,999 are written as hybrid-36.
/// @throws InputError where the format has no room, pointing to mmCIF: chain names of two letters,
/// atom or
///         residue names of five, coordinates that are not within -999.999 and 9,999.999 angstrom
[[nodiscard]] std::string format_pdb_atoms(const Molecule& molecule, const RigidMotion& motion = {},
                                           const FormatPdbOptions& options = {});

/// `atoms` between MODEL and ENDMDL records. A file of models ends with "END\n".
/// @throws InputError unless 1 <= number <= 99,999,999
[[nodiscard]] std::string format_pdb_model(int number, const std::string& atoms);

struct FormatMmcifOptions {
  int first_serial = 1;
  int model = 1;
};

/// The head of an mmCIF file with one atom_site loop; rows of format_mmcif_atoms() follow it.
/// @param block_name  what stands after "data_"; blanks become underscores
[[nodiscard]] std::string format_mmcif_head(const std::string& block_name);

/// atom_site rows of a molecule moved by `motion`; any number of molecules and models may follow
/// each other.
/// @throws InputError if a coordinate is not finite or a name cannot be quoted
[[nodiscard]] std::string format_mmcif_atoms(const Molecule& molecule,
                                             const RigidMotion& motion = {},
                                             const FormatMmcifOptions& options = {});

/// `moving` with those chains renamed that `fixed` has too, to the first free letters (A-Z, a-z,
/// 0-9, then AA...), so that both can stand in one file.
[[nodiscard]] Molecule with_distinct_chains(Molecule moving, const Molecule& fixed);

}  // namespace mortise
