// SPDX-License-Identifier: GPL-3.0-or-later
// Telling polymer residues, heavy atoms and backbone atoms.
#include "metrics/polymer.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>
#include <utility>

namespace mortise::detail {
namespace {

// Parents by the PDB's Chemical Component Dictionary (_chem_comp.mon_nstd_parent_comp_id), and the
// names that force fields give to protonation states.
constexpr std::array<std::pair<std::string_view, std::string_view>, 40> kParents{{
    {"MSE", "MET"}, {"FME", "MET"}, {"MHO", "MET"}, {"SEP", "SER"}, {"TPO", "THR"}, {"PTR", "TYR"},
    {"TYS", "TYR"}, {"HYP", "PRO"}, {"MLY", "LYS"}, {"M3L", "LYS"}, {"ALY", "LYS"}, {"KCX", "LYS"},
    {"LLP", "LYS"}, {"LYN", "LYS"}, {"CSO", "CYS"}, {"CSD", "CYS"}, {"CSS", "CYS"}, {"CME", "CYS"},
    {"OCS", "CYS"}, {"CAS", "CYS"}, {"CSX", "CYS"}, {"CYX", "CYS"}, {"CYM", "CYS"}, {"SEC", "CYS"},
    {"PCA", "GLN"}, {"CGU", "GLU"}, {"GLH", "GLU"}, {"ASH", "ASP"}, {"HID", "HIS"}, {"HIE", "HIS"},
    {"HIP", "HIS"}, {"HSD", "HIS"}, {"HSE", "HIS"}, {"HSP", "HIS"}, {"HIC", "HIS"}, {"AGM", "ARG"},
    {"PSU", "U"},   {"5MU", "U"},   {"5MC", "C"},   {"OMG", "G"},
}};

// Ends of a peptide that are no residues.
constexpr std::array<std::string_view, 4> kCaps{"ACE", "FOR", "NH2", "NME"};

constexpr std::array<std::string_view, 4> kPeptideBackbone{"N", "CA", "C", "O"};
constexpr std::array<std::string_view, 12> kNucleicBackbone{
    "P", "OP1", "OP2", "O5'", "C5'", "C4'", "O4'", "C3'", "O3'", "C2'", "O2'", "C1'"};

const Atom* find_atom(const Molecule& molecule, const ResidueRange& range, std::string_view name) {
  for (std::size_t i = range.first; i < range.last; ++i)
    if (canonical_atom_name(molecule.atoms[i].name) == name) return &molecule.atoms[i];
  return nullptr;
}

bool has_sugar_or_phosphate(const Molecule& molecule, const ResidueRange& range) {
  for (std::size_t i = range.first; i < range.last; ++i) {
    const std::string name = canonical_atom_name(molecule.atoms[i].name);
    if (name == "P" || (!name.empty() && name.back() == '\'')) return true;
  }
  return false;
}

bool bonded(const Molecule& molecule, const ResidueRange& first, std::string_view first_name,
            const ResidueRange& second, std::string_view second_name) {
  constexpr double kLongestBond = 2.0;  // angstrom: C-N 1.33, O3'-P 1.61, and room for poor models
  const Atom* a = find_atom(molecule, first, first_name);
  const Atom* b = find_atom(molecule, second, second_name);
  return a != nullptr && b != nullptr && (a->position - b->position).norm() < kLongestBond;
}

bool joined(const Molecule& molecule, const ResidueRange& first, const ResidueRange& second) {
  return bonded(molecule, first, "C", second, "N") || bonded(molecule, first, "O3'", second, "P");
}

}  // namespace

std::string canonical_atom_name(std::string name) {
  std::replace(name.begin(), name.end(), '*', '\'');
  if (name == "O1P") return "OP1";
  if (name == "O2P") return "OP2";
  return name;
}

bool is_hydrogen(const Atom& atom) {
  if (!atom.element.empty()) return atom.element == "H" || atom.element == "D";
  const auto first = std::find_if(atom.name.begin(), atom.name.end(), [](unsigned char c) {
    return std::isdigit(c) == 0;  // "1HB"
  });
  return first != atom.name.end() && (*first == 'H' || *first == 'D');
}

std::string parent_residue_name(const std::string& name) {
  for (const auto& [modified, parent] : kParents)
    if (name == modified) return std::string(parent);
  return name;
}

std::vector<PolymerResidue> polymer_residues(const Molecule& molecule) {
  std::vector<PolymerResidue> out;
  const std::vector<ResidueRange> ranges = residues(molecule);
  for (std::size_t k = 0; k < ranges.size(); ++k) {
    const ResidueRange& range = ranges[k];
    const Atom& head = molecule.atoms[range.first];
    if (std::find(kCaps.begin(), kCaps.end(), head.residue_name) != kCaps.end()) continue;
    // Poorly resolved residues may lack any atom, CA too: what is left of them still counts.
    const bool amino_acid = find_atom(molecule, range, "CA") != nullptr;
    const bool nucleotide = !amino_acid && has_sugar_or_phosphate(molecule, range);
    if (head.hetero && !(k > 0 && joined(molecule, ranges[k - 1], range)) &&
        !(k + 1 < ranges.size() && joined(molecule, range, ranges[k + 1])))
      continue;

    PolymerResidue residue{k,
                           head.chain,
                           head.residue_number,
                           head.insertion_code,
                           parent_residue_name(head.residue_name),
                           {}};
    for (std::size_t i = range.first; i < range.last; ++i) {
      const Atom& atom = molecule.atoms[i];
      if (is_hydrogen(atom)) continue;
      PolymerAtom kept{canonical_atom_name(atom.name), atom.position, false};
      const auto same_name = [&](const PolymerAtom& other) { return other.name == kept.name; };
      if (std::any_of(residue.atoms.begin(), residue.atoms.end(), same_name)) continue;
      kept.backbone = nucleotide ? std::find(kNucleicBackbone.begin(), kNucleicBackbone.end(),
                                             kept.name) != kNucleicBackbone.end()
                                 : std::find(kPeptideBackbone.begin(), kPeptideBackbone.end(),
                                             kept.name) != kPeptideBackbone.end();
      residue.atoms.push_back(std::move(kept));
    }
    if (!residue.atoms.empty()) out.push_back(std::move(residue));
  }
  return out;
}

}  // namespace mortise::detail
