// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Atoms and molecules as Mortise sees them.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace mortise {

struct Atom {
  std::string name;          ///< as in the file, without blanks: "CA"
  std::string residue_name;  ///< "ALA"
  std::string chain;         ///< chain identifier of the file; may be empty
  int residue_number = 0;
  std::string insertion_code;                          ///< empty or one letter
  std::string element;                                 ///< "C", "Zn"; empty if it cannot be told
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< angstrom, the file's frame
  bool hetero = false;                                 ///< neither amino acid nor nucleotide
};

struct Molecule {
  std::string path;         ///< the file it was read from
  std::vector<Atom> atoms;  ///< in file order; the atoms of a residue are contiguous
};

/// The atoms [first, last) of one residue.
struct ResidueRange {
  std::size_t first = 0;
  std::size_t last = 0;
};

/// Splits the atoms into residues wherever chain, number, insertion code or residue name changes.
[[nodiscard]] std::vector<ResidueRange> residues(const Molecule& molecule);

}  // namespace mortise
