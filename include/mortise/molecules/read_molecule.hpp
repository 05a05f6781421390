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
  int model = 0;                         ///< number of the MODEL record; 0 = the first of the file
  std::vector<std::string> chains = {};  ///< empty = all; "_" = the chain without a name
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

/// Reads one structure through OpenMM (openmm.app.PDBFile or PDBxFile; .gz is unpacked first).
///
/// The text is checked before OpenMM sees it, so that errors carry its line (of the unpacked text).
/// Of alternate locations the first is kept, per atom. Names are those of the file; OpenMM's
/// renaming to its own (HSD to HIS, O1P to OP1) is off. mmCIF chains, residue numbers and names are
/// the authors' (auth_*). Residue numbers beyond 9,999 may be hybrid-36; serial numbers are not
/// used. The element is that of the element column where it fits the atom name, else that of the
/// name. Safe to call from several threads; OpenMM itself reads one file at a time.
///
/// @throws FileError for a missing, unreadable, empty or malformed file, coordinates that are not
///         finite or not below 9,999 angstrom, with the line where there is one
/// @throws InputError for a chain or model that is not there, chains of CA (or P) atoms only, all
///         atoms in one point, more than 2,000,000 atoms, and if nothing is left to read
[[nodiscard]] ReadMoleculeResult read_molecule(const MoleculeSpec& spec,
                                               const ReadMoleculeOptions& options = {});

}  // namespace mortise
