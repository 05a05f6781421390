// SPDX-License-Identifier: GPL-3.0-or-later
// Donors and acceptors by residue and atom name.
#include "metrics/hydrogen_bonds.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include "core/point_grid.hpp"
#include "metrics/polymer.hpp"
#include "molecules/residue_kinds.hpp"
#include "mortise/molecules/radii.hpp"

namespace mortise::detail {
namespace {

using Names = std::string_view;  // each name with a blank on both sides

struct Polar {
  Names residue;
  Names donors;
  Names acceptors;
};

// Side chains of the amino acids.
constexpr std::array<Polar, 12> kSideChains{{
    {"ARG", " NE NH1 NH2 ", " "},
    {"ASN", " ND2 ", " OD1 "},
    {"ASP", " ", " OD1 OD2 "},
    {"GLN", " NE2 ", " OE1 "},
    {"GLU", " ", " OE1 OE2 "},
    {"HIS", " ND1 NE2 ", " ND1 NE2 "},  // which of the two has the hydrogen is not known
    {"LYS", " NZ ", " "},
    {"SER", " OG ", " OG "},
    {"THR", " OG1 ", " OG1 "},
    {"TRP", " NE1 ", " "},
    {"TYR", " OH ", " OH "},
    {"HYP", " OD1 ", " OD1 "},
}};

// Bases; A, C, G, U and T with and without D in front.
constexpr std::array<Polar, 5> kBases{{
    {"A", " N6 ", " N1 N3 N7 "},
    {"C", " N4 ", " N3 O2 "},
    {"G", " N1 N2 ", " N3 N7 O6 "},
    {"U", " N3 ", " O2 O4 "},
    {"T", " N3 ", " O2 O4 "},
}};

bool lists(Names names, const std::string& name) {
  return names.find(" " + name + " ") != Names::npos;
}

PolarAtom polarity(const Atom& atom) {
  PolarAtom out;
  if (atom.element != "N" && atom.element != "O") return out;
  const std::string name = canonical_atom_name(atom.name);
  if (!atom.hetero && molecules::is_amino_acid(atom.residue_name)) {
    const std::string residue = parent_residue_name(atom.residue_name);
    out.donor = name == "N" && residue != "PRO" && atom.residue_name != "HYP";
    out.acceptor = name == "O" || name == "OXT";
    for (const Polar& entry : kSideChains)
      if (entry.residue == residue || entry.residue == atom.residue_name) {
        out.donor = out.donor || lists(entry.donors, name);
        out.acceptor = out.acceptor || lists(entry.acceptors, name);
      }
    // What is left of modified residues' oxygens, phosphates and sulphates above all, can accept.
    if (atom.element == "O" && !out.polar() && residue != atom.residue_name) out.acceptor = true;
  } else if (!atom.hetero && molecules::is_nucleotide(atom.residue_name)) {
    if (name.back() == '\'' || name.rfind("OP", 0) == 0) {
      out.acceptor = atom.element == "O";
      out.donor = name == "O2'";
      return out;
    }
    std::string base = parent_residue_name(atom.residue_name);
    if (base.size() == 2 && base[0] == 'D') base.erase(0, 1);
    for (const Polar& entry : kBases)
      if (entry.residue == base) {
        out.donor = lists(entry.donors, name);
        out.acceptor = lists(entry.acceptors, name);
      }
  } else {
    out.donor = out.acceptor = true;
  }
  return out;
}

}  // namespace

std::vector<PolarAtom> polar_atoms(const Molecule& heavy) {
  std::vector<PolarAtom> out;
  out.reserve(heavy.atoms.size());
  for (const Atom& atom : heavy.atoms) out.push_back(polarity(atom));
  // N and O are bonded to C, N, O, P and S: at most 1.75 A long, with room for coordinates that are
  // not exact, and well below the 2.2 A to the next atom but one.
  constexpr double kBond = 1.9;
  const Eigen::Matrix3Xd positions = atom_positions(heavy);
  const PointGrid grid(positions, kBond, kBond);
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (!out[i].polar()) continue;
    const Eigen::Vector3d at = heavy.atoms[i].position;
    std::vector<Eigen::Vector3d> found;
    grid.for_each_near(at, [&](std::int32_t k) {
      const Eigen::Vector3d step = positions.col(k) - at;
      if (step.squaredNorm() > 0.25) found.push_back(step.normalized());  // not itself
    });
    out[i].bonded.resize(3, static_cast<Eigen::Index>(found.size()));
    for (std::size_t k = 0; k < found.size(); ++k)
      out[i].bonded.col(static_cast<Eigen::Index>(k)) = found[k];
  }
  return out;
}

bool faces(const PolarAtom& atom, const Eigen::Vector3d& towards, double most) {
  const Eigen::Vector3d u = towards.normalized();
  for (Eigen::Index k = 0; k < atom.bonded.cols(); ++k)
    if (atom.bonded.col(k).dot(u) > most) return false;
  return true;
}

}  // namespace mortise::detail
