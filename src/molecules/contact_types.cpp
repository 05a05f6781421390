// SPDX-License-Identifier: GPL-3.0-or-later
// The kinds of atoms that a contact potential tells apart.
#include "mortise/molecules/contact_types.hpp"

#include <algorithm>
#include <initializer_list>
#include <string_view>

namespace mortise {
namespace {

bool one_of(std::string_view name, std::initializer_list<std::string_view> names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

int side_chain_type(std::string_view residue, std::string_view atom) {
  const char element = atom.front();
  if (residue == "LYS") return atom == "NZ" ? 7 : atom == "CG" ? 5 : 8;
  if (residue == "ARG")
    return atom == "CG" ? 5 : atom == "CD" ? 8 : one_of(atom, {"CZ", "NE"}) ? 9 : 10;
  if (residue == "ASP") return element == 'O' ? 11 : 12;
  if (residue == "GLU") return element == 'O' ? 11 : atom == "CD" ? 12 : 5;
  if (residue == "ASN") return element == 'O' ? 13 : 14;
  if (residue == "GLN") return element == 'O' ? 13 : element == 'N' || atom == "CD" ? 14 : 5;
  if (one_of(residue, {"SER", "THR"})) return element == 'O' ? 15 : 5;
  if (residue == "HIS") return 16;
  if (residue == "TYR") return atom == "OH" ? 15 : 17;
  if (residue == "PHE") return 18;
  if (residue == "TRP") return 19;
  if (one_of(residue, {"MET", "MSE", "CYS"})) return 20;
  if (residue == "PRO") return 5;
  return 21;  // LEU, ILE, VAL
}

}  // namespace

int contact_type(const Atom& atom) {
  const std::string_view residue = atom.residue_name, name = atom.name;
  if (atom.element == "H" || atom.element == "D" || name.empty()) return -1;
  if (!one_of(residue, {"ALA", "ARG", "ASN", "ASP", "CYS", "GLN", "GLU", "GLY", "HIS", "ILE", "LEU",
                        "LYS", "MET", "MSE", "PHE", "PRO", "SER", "THR", "TRP", "TYR", "VAL"}))
    return -1;
  if (name == "N") return 0;
  if (name == "CA") return residue == "GLY" ? 4 : 1;
  if (name == "C") return 2;
  if (name == "O" || name == "OXT") return 3;
  if (name == "CB")
    return one_of(residue, {"ALA", "ILE", "VAL", "LEU", "MET", "CYS", "PHE", "TRP", "TYR"}) ? 6 : 5;
  return side_chain_type(residue, name);
}

Eigen::VectorXi contact_types(const Molecule& molecule) {
  Eigen::VectorXi types(static_cast<Eigen::Index>(molecule.atoms.size()));
  for (Eigen::Index i = 0; i < types.size(); ++i) types[i] = contact_type(molecule.atoms[i]);
  return types;
}

}  // namespace mortise
