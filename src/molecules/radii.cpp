// SPDX-License-Identifier: GPL-3.0-or-later
// The ProtOr table of united-atom radii and the radii of elements.
#include "mortise/molecules/radii.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "molecules/residue_kinds.hpp"

namespace mortise {
namespace {

// Tsai et al. 1999, Table 2: the element, its number of bonded partners, and the hydrogens among
// them.
constexpr double kC3H0 = 1.61, kC3H1 = 1.76, kC4 = 1.88, kN = 1.64, kO1H0 = 1.42, kO2H1 = 1.46,
                 kS = 1.77;

using Names = std::string_view;  // atom names, each with a blank on both sides

/// Side-chain carbons with three partners; all others have four. Common variants share their
/// parent's entry.
struct TrigonalCarbons {
  Names residues;
  Names without_hydrogen;
  Names with_hydrogen;
};
constexpr std::array<TrigonalCarbons, 8> kTrigonal = {{
    {" ARG ARN ", " CZ ", " "},
    {" ASN ASP ASH ASX ", " CG ", " "},
    {" GLN GLU GLH GLX PCA ", " CD ", " "},
    {" CGU ", " CD1 CD2 ", " "},
    {" HIS HID HIE HIP HSD HSE HSP ", " CG ", " CD2 CE1 "},
    {" PHE ", " CG ", " CD1 CD2 CE1 CE2 CZ "},
    {" TYR PTR TYS ", " CG CZ ", " CD1 CD2 CE1 CE2 "},
    {" TRP ", " CG CD2 CE2 ", " CD1 CE3 CZ2 CZ3 CH2 "},
}};

bool lists(Names names, std::string_view name) {
  if (name.empty() || name.size() > 6) return false;
  char key[8];
  key[0] = ' ';
  name.copy(key + 1, name.size());
  key[name.size() + 1] = ' ';
  return names.find(std::string_view(key, name.size() + 2)) != Names::npos;
}

double carbon_radius(const Atom& atom) {
  if (atom.name == "C") return kC3H0;
  for (const TrigonalCarbons& entry : kTrigonal) {
    if (!lists(entry.residues, atom.residue_name)) continue;
    if (lists(entry.without_hydrogen, atom.name)) return kC3H0;
    if (lists(entry.with_hydrogen, atom.name)) return kC3H1;
  }
  return kC4;
}

double oxygen_radius(const Atom& atom) {
  const bool hydroxyl =
      atom.name == "OG" || atom.name == "OG1" || (atom.name == "OH" && atom.residue_name == "TYR");
  return hydroxyl ? kO2H1 : kO1H0;
}

constexpr std::array<std::pair<std::string_view, double>, 44> kElementRadii = {{
    // Bondi 1964
    {"H", 1.20},
    {"He", 1.40},
    {"C", 1.70},
    {"N", 1.55},
    {"O", 1.52},
    {"F", 1.47},
    {"Ne", 1.54},
    {"Na", 2.27},
    {"Mg", 1.73},
    {"Si", 2.10},
    {"P", 1.80},
    {"S", 1.80},
    {"Cl", 1.75},
    {"Ar", 1.88},
    {"K", 2.75},
    {"Ni", 1.63},
    {"Cu", 1.40},
    {"Zn", 1.39},
    {"Ga", 1.87},
    {"As", 1.85},
    {"Se", 1.90},
    {"Br", 1.85},
    {"Kr", 2.02},
    {"Pd", 1.63},
    {"Ag", 1.72},
    {"Cd", 1.58},
    {"In", 1.93},
    {"Sn", 2.17},
    {"Te", 2.06},
    {"I", 1.98},
    {"Xe", 2.16},
    {"Pt", 1.75},
    {"Au", 1.66},
    {"Hg", 1.55},
    {"Pb", 2.02},
    {"Li", 1.82},
    // Mantina et al. 2009
    {"Be", 1.53},
    {"B", 1.92},
    {"Al", 1.84},
    {"Ca", 2.31},
    {"Rb", 3.03},
    {"Sr", 2.49},
    {"Cs", 3.43},
    {"Ba", 2.68},
}};

}  // namespace

double element_radius(const std::string& element) {
  constexpr double kOther = 2.0;
  const auto* found = std::find_if(kElementRadii.begin(), kElementRadii.end(),
                                   [&](const auto& entry) { return entry.first == element; });
  return found == kElementRadii.end() ? kOther : found->second;
}

double atom_radius(const Atom& atom) {
  if (!atom.hetero && molecules::is_amino_acid(atom.residue_name)) {
    if (atom.element == "C") return carbon_radius(atom);
    if (atom.element == "N") return kN;
    if (atom.element == "O") return oxygen_radius(atom);
    if (atom.element == "S") return kS;
  }
  return element_radius(atom.element);
}

Eigen::VectorXd atom_radii(const Molecule& molecule) {
  Eigen::VectorXd radii(static_cast<Eigen::Index>(molecule.atoms.size()));
  for (Eigen::Index i = 0; i < radii.size(); ++i)
    radii[i] = atom_radius(molecule.atoms[static_cast<std::size_t>(i)]);
  return radii;
}

Eigen::Matrix3Xd atom_positions(const Molecule& molecule) {
  Eigen::Matrix3Xd positions(3, static_cast<Eigen::Index>(molecule.atoms.size()));
  for (Eigen::Index i = 0; i < positions.cols(); ++i)
    positions.col(i) = molecule.atoms[static_cast<std::size_t>(i)].position;
  return positions;
}

Eigen::Matrix4Xd atom_balls(const Molecule& molecule) {
  Eigen::Matrix4Xd balls(4, static_cast<Eigen::Index>(molecule.atoms.size()));
  balls.topRows<3>() = atom_positions(molecule);
  balls.row(3) = atom_radii(molecule).transpose();
  return balls;
}

}  // namespace mortise
