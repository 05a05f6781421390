// SPDX-License-Identifier: GPL-3.0-or-later
// AMBER's united-atom radii by residue and atom name.
#include <string>
#include <string_view>

#include "metrics/polymer.hpp"
#include "molecules/residue_kinds.hpp"
#include "mortise/metrics/shape_complementarity.hpp"
#include "mortise/molecules/radii.hpp"

namespace mortise {
namespace {

constexpr double kMethyl = 2.00, kMethylene = 1.925, kOtherCarbon = 1.85;
constexpr double kNitrogen = 1.75, kAmmonium = 1.85, kOxygen = 1.60, kHydroxyl = 1.65;
constexpr double kSulphur = 2.00, kPhosphorus = 2.10, kCarbonOutside = 1.90;

bool lists(std::string_view names, const std::string& residue, const std::string& atom) {
  return names.find(" " + residue + ":" + atom + " ") != std::string_view::npos;
}

double carbon(const Atom& atom) {
  const std::string residue = detail::parent_residue_name(atom.residue_name);
  if (lists(" ALA:CB VAL:CG1 VAL:CG2 LEU:CD1 LEU:CD2 ILE:CG2 ILE:CD1 ILE:CD THR:CG2 MET:CE ",
            residue, atom.name))
    return kMethyl;
  if (lists(" VAL:CB ILE:CB THR:CB LEU:CG ", residue, atom.name)) return kOtherCarbon;
  if (atom.name == "CA" && residue != "GLY") return kOtherCarbon;
  // The smallest carbon that ProtOr has with four partners; those with three are flat.
  return atom_radius(atom) < 1.8 ? kOtherCarbon : kMethylene;
}

double radius(const Atom& atom) {
  const bool residue = !atom.hetero && molecules::is_amino_acid(atom.residue_name);
  const std::string& element = atom.element;
  if (element == "C") return residue ? carbon(atom) : kCarbonOutside;
  if (element == "N") return residue && atom.name == "NZ" ? kAmmonium : kNitrogen;
  if (element == "O") {
    const bool hydroxyl = atom.name == "OG" || atom.name == "OG1" || atom.name == "OH";
    return !residue || hydroxyl ? kHydroxyl : kOxygen;
  }
  if (element == "S") return kSulphur;
  if (element == "P") return kPhosphorus;
  return element_radius(element);
}

}  // namespace

Eigen::VectorXd complementarity_radii(const Molecule& molecule) {
  Eigen::VectorXd radii(static_cast<Eigen::Index>(molecule.atoms.size()));
  for (Eigen::Index i = 0; i < radii.size(); ++i)
    radii[i] = radius(molecule.atoms[static_cast<std::size_t>(i)]);
  return radii;
}

}  // namespace mortise
