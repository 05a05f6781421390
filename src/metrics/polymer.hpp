// SPDX-License-Identifier: GPL-3.0-or-later
// The residues of a molecule that metrics count: amino acids and nucleotides, waters and cofactors
// left out.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

#include "mortise/molecules/molecule.hpp"

namespace mortise::detail {

struct PolymerAtom {
  std::string name;  // canonical: "OP1", "C4'"
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  bool backbone = false;
};

struct PolymerResidue {
  std::size_t index = 0;  // in residues(molecule)
  std::string chain;
  int number = 0;
  std::string insertion_code;
  std::string name;                // of the standard parent: MSE -> MET
  std::vector<PolymerAtom> atoms;  // heavy, one per name, file order
};

// Backbone is N, CA, C, O of an amino acid and, as in DockQ 2, the sugar and phosphate of a
// nucleotide: P, OP1, OP2, O5', C5', C4', O4', C3', O3', C2', O2', C1'. A hetero group counts as
// modified residue only where a peptide or phosphodiester bond joins it to the residue before or
// after, so that free amino acids, ATP or FMN do not.
[[nodiscard]] std::vector<PolymerResidue> polymer_residues(const Molecule& molecule);

// The standard residue a modified or protonation-state name stands for; the name itself if there is
// none.
[[nodiscard]] std::string parent_residue_name(const std::string& name);

// PDB format 3 names: primes for asterisks, OP1 for O1P.
[[nodiscard]] std::string canonical_atom_name(std::string name);

// Hydrogen or deuterium, by element, else by name.
[[nodiscard]] bool is_hydrogen(const Atom& atom);

}  // namespace mortise::detail
