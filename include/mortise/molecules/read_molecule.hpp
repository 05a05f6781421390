// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Reading molecules from PDB and PDBx/mmCIF files.
#pragma once

#include <string>
#include <vector>

#include "mortise/molecules/molecule.hpp"

namespace mortise {

/// A structure file and the part of it that is meant: "complex.pdb", "complex.cif.gz:A,B",
/// "complex.pdb#2:A".
struct MoleculeSpec {
  std::string path;
  int model = 0;                    ///< 1-based model number; 0 = the first of the file
  std::vector<std::string> chains;  ///< empty = all
};

/// Parses "path[#model][:chain,chain]". A file whose whole name exists is taken as it stands.
/// @throws InputError if the model is not a positive number or a chain name is empty
[[nodiscard]] MoleculeSpec parse_molecule_spec(const std::string& text);

struct ReadMoleculeOptions {
  bool keep_hydrogens = false;
  bool keep_waters = false;
  bool keep_ligands = true;  ///< hetero groups of more than one heavy atom, cofactors included
  bool keep_ions = true;     ///< hetero groups of one heavy atom
};

/// A molecule and what was decided in reading it.
struct ReadMoleculeResult {
  Molecule molecule;
  std::vector<std::string> decisions;  ///< one line each, for the user: "dropped 120 waters"
};

/// Reads one structure through OpenMM (openmm.app.PDBFile or PDBxFile; .gz is unpacked first),
/// first alternate location.
///
/// @throws FileError for a missing, unreadable, empty or malformed file, with the line where there
/// is one
/// @throws InputError for a chain or model that is not there, CA-only chains, coordinates that are
/// not finite or beyond
///         9,999 angstrom, and more than 2,000,000 atoms
[[nodiscard]] ReadMoleculeResult read_molecule(const MoleculeSpec& spec,
                                               const ReadMoleculeOptions& options = {});

}  // namespace mortise
