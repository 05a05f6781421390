// SPDX-License-Identifier: GPL-3.0-or-later
// Reading a molecule: scan, select, read through OpenMM, report the decisions.
#include "mortise/molecules/read_molecule.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "molecules/atom_records.hpp"
#include "molecules/openmm_reader.hpp"
#include "molecules/residue_kinds.hpp"
#include "mortise/core/errors.hpp"

namespace mortise {
namespace {

using molecules::AtomRecord;
using Records = std::vector<AtomRecord>;

constexpr std::size_t kMostAtoms = 2'000'000;

std::string shown(const std::string& chain) { return chain.empty() ? "_" : chain; }

std::string counted(std::size_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

template <typename Range>
std::string joined(const Range& items, std::size_t most = 30) {
  std::string text;
  std::size_t n = 0;
  for (const std::string& item : items) {
    if (n == most) return text + ", ... (" + std::to_string(std::size(items)) + ")";
    text += (n++ == 0 ? "" : ", ") + item;
  }
  return text;
}

Records select_model(Records records, const MoleculeSpec& spec,
                     std::vector<std::string>& decisions) {
  std::set<int> models;
  for (const AtomRecord& record : records) models.insert(record.model);
  const int wanted = spec.model > 0 ? spec.model : records.front().model;
  if (!models.contains(wanted)) {
    std::vector<std::string> names;
    names.reserve(models.size());
    for (const int model : models) names.push_back(std::to_string(model));
    throw InputError(spec.path + ": expected model " + std::to_string(wanted) + ", found " +
                     (names.size() == 1 ? "only model " : "models ") + joined(names));
  }
  if (models.size() > 1) {
    std::erase_if(records, [&](const AtomRecord& r) { return r.model != wanted; });
    decisions.push_back("took model " + std::to_string(wanted) + " of " +
                        std::to_string(models.size()));
  }
  return records;
}

Records select_chains(Records records, const MoleculeSpec& spec,
                      std::vector<std::string>& decisions) {
  std::vector<std::string> there;
  for (const AtomRecord& record : records)
    if (there.empty() || there.back() != shown(record.atom.chain))
      if (std::find(there.begin(), there.end(), shown(record.atom.chain)) == there.end())
        there.push_back(shown(record.atom.chain));
  if (spec.chains.empty()) return records;
  for (const std::string& chain : spec.chains)
    if (std::find(there.begin(), there.end(), chain) == there.end())
      throw InputError(spec.path + ": expected chain " + chain + ", found " +
                       (there.size() == 1 ? "only chain " : "chains ") + joined(there));
  std::erase_if(records, [&](const AtomRecord& r) {
    return std::find(spec.chains.begin(), spec.chains.end(), shown(r.atom.chain)) ==
           spec.chains.end();
  });
  if (there.size() > 1)
    decisions.push_back("took " + std::string(spec.chains.size() == 1 ? "chain " : "chains ") +
                        joined(spec.chains) + " of " + joined(there));
  return records;
}

bool same_place(const Atom& a, const Atom& b) {
  return a.residue_number == b.residue_number && a.chain == b.chain &&
         a.insertion_code == b.insertion_code;
}

/// Calls body(first, last) for each run of records at one place of the chain (residue names may
/// differ).
template <typename Body>
void for_each_place(const Records& records, const Body& body) {
  for (std::size_t first = 0, last = 0; first < records.size(); first = last) {
    while (last < records.size() && same_place(records[first].atom, records[last].atom)) ++last;
    body(first, last);
  }
}

Records first_alternates(Records records, std::vector<std::string>& decisions) {
  std::vector<bool> keep(records.size(), true);
  std::size_t dropped = 0, repeated = 0;
  for_each_place(records, [&](std::size_t first, std::size_t last) {
    // Blank alternates that change the residue name start a new residue; lettered ones are a point
    // mutation.
    std::set<std::pair<std::string, std::string>> seen;
    std::string mutant_of;
    bool lettered = false;
    for (std::size_t i = first; i < last; ++i) {
      AtomRecord& r = records[i];
      if (!r.alternate.empty()) {
        if (!lettered) mutant_of = r.atom.residue_name;
        lettered = true;
        keep[i] = r.atom.residue_name == mutant_of && seen.insert({mutant_of, r.atom.name}).second;
        dropped += !keep[i];
      } else if (!seen.insert({r.atom.residue_name, r.atom.name}).second) {
        const bool polymer = molecules::is_amino_acid(r.atom.residue_name) ||
                             molecules::is_nucleotide(r.atom.residue_name);
        keep[i] = !polymer;
        r.repeated_name = !polymer;
        repeated += polymer;
      }
    }
  });
  std::size_t i = 0;
  std::erase_if(records, [&](const AtomRecord&) { return !keep[i++]; });
  if (dropped > 0)
    decisions.push_back("kept the first alternate location of each atom, dropped " +
                        counted(dropped, "other"));
  if (repeated > 0)
    decisions.push_back("dropped " + counted(repeated, "atom") +
                        " that stand in their residue twice");
  return records;
}

double distance(const Records& records, std::size_t i, std::size_t j) {
  return (records[i].atom.position - records[j].atom.position).norm();
}

/// Marks every residue that is neither amino acid nor nucleotide, by name or by its bonds to its
/// neighbours.
void mark_hetero(Records& records) {
  std::vector<ResidueRange> ranges;
  for_each_place(records, [&](std::size_t first, std::size_t last) {
    ranges.push_back({first, last});
  });
  const auto find = [&](const ResidueRange& range, const char* name) {
    for (std::size_t i = range.first; i < range.last; ++i)
      if (records[i].atom.name == name) return i;
    return records.size();
  };
  const auto bonded = [&](std::size_t k, const char* end, const char* start, double most) {
    if (k + 1 >= ranges.size()) return false;
    const std::size_t i = find(ranges[k], end), j = find(ranges[k + 1], start);
    return i < records.size() && j < records.size() && distance(records, i, j) < most;
  };
  std::vector<bool> linked(ranges.size() + 1, false);  // residue k - 1 to residue k
  for (std::size_t k = 0; k + 1 < ranges.size(); ++k)
    linked[k + 1] =
        bonded(k, "C", "N", 1.7) || bonded(k, "O3'", "P", 2.0);  // C-N 1.33, O3'-P 1.61 A
  for (std::size_t k = 0; k < ranges.size(); ++k)
    for (std::size_t i = ranges[k].first; i < ranges[k].last; ++i) {
      const std::string& name = records[i].atom.residue_name;
      records[i].atom.hetero = !molecules::is_amino_acid(name) && !molecules::is_nucleotide(name) &&
                               !linked[k] && !linked[k + 1];
    }
}

Records select_groups(Records records, const ReadMoleculeOptions& options,
                      std::vector<std::string>& decisions) {
  std::vector<bool> keep(records.size(), true);
  std::size_t waters = 0, hydrogens = 0;
  std::map<std::string, std::size_t> kept, dropped;
  for_each_place(records, [&](std::size_t first, std::size_t last) {
    const auto is_hydrogen = [&](std::size_t i) { return records[i].atom.element == "H"; };
    std::size_t heavy = 0;
    for (std::size_t i = first; i < last; ++i) heavy += !is_hydrogen(i);
    const Atom& lead = records[first].atom;
    const bool water = molecules::is_water(lead.residue_name);
    const bool group = lead.hetero && !water && heavy > 0;
    const bool keep_group = water   ? options.keep_waters
                            : group ? (heavy == 1 ? options.keep_ions : options.keep_ligands)
                                    : true;
    if (water && !keep_group) waters += std::max<std::size_t>(heavy, 1);
    if (group) ++(keep_group ? kept : dropped)[lead.residue_name];
    for (std::size_t i = first; i < last; ++i) {
      keep[i] = keep_group && (options.keep_hydrogens || !is_hydrogen(i));
      hydrogens += keep_group && !keep[i];
    }
  });
  std::size_t i = 0;
  std::erase_if(records, [&](const AtomRecord&) { return !keep[i++]; });
  if (waters > 0) decisions.push_back("dropped " + counted(waters, "water"));
  if (hydrogens > 0) decisions.push_back("dropped " + counted(hydrogens, "hydrogen"));
  for (const auto& [groups, verb] : {std::pair(&kept, "kept"), std::pair(&dropped, "dropped")}) {
    std::vector<std::string> names;
    for (const auto& [name, count] : *groups)
      names.push_back(count == 1 ? name : std::to_string(count) + " " + name);
    if (!names.empty())
      decisions.push_back(std::string(verb) + " ligands and ions: " + joined(names));
  }
  return records;
}

void refuse_traces(const Records& records, const std::string& path) {
  struct Count {
    std::size_t residues = 0, single = 0;
  };
  std::map<std::string, Count> chains;
  for_each_place(records, [&](std::size_t first, std::size_t last) {
    const Atom& atom = records[first].atom;
    if (atom.hetero) return;
    Count& count = chains[atom.chain];
    ++count.residues;
    count.single += last - first == 1 && (atom.name == "CA" || atom.name == "P");
  });
  for (const auto& [chain, count] : chains)
    if (count.residues >= 2 && 2 * count.single > count.residues)
      throw InputError(path + ": chain " + shown(chain) + ": expected all heavy atoms, found " +
                       std::to_string(count.single) + " of " + counted(count.residues, "residue") +
                       " with a CA (or P) atom only");
}

void refuse_one_point(const Records& records, const std::string& path) {
  const auto at_first = [&](const AtomRecord& r) {
    return r.atom.position == records.front().atom.position;
  };
  if (records.size() > 1 && std::all_of(records.begin(), records.end(), at_first))
    throw InputError(path + ": expected atoms in different places, found all " +
                     std::to_string(records.size()) + " in one point");
}

}  // namespace

ReadMoleculeResult read_molecule(const MoleculeSpec& spec, const ReadMoleculeOptions& options) {
  const std::string text = molecules::read_text(spec.path);
  const molecules::Format format = molecules::detect_format(spec.path, text);
  Records records = format == molecules::Format::kMmcif ? molecules::scan_mmcif(spec.path, text)
                                                        : molecules::scan_pdb(spec.path, text);
  if (records.empty())
    throw FileError(
        spec.path,
        std::string("expected atoms, found no ") +
            (format == molecules::Format::kMmcif ? "atom_site rows" : "ATOM or HETATM records"));
  ReadMoleculeResult result;
  records = select_model(std::move(records), spec, result.decisions);
  records = select_chains(std::move(records), spec, result.decisions);
  records = first_alternates(std::move(records), result.decisions);
  mark_hetero(records);
  const std::size_t all = records.size();
  records = select_groups(std::move(records), options, result.decisions);
  if (records.empty())
    throw InputError(spec.path + ": nothing is left of " + counted(all, "atom") +
                     " after dropping waters, hydrogens and unwanted groups");
  if (records.size() > kMostAtoms)
    throw InputError(spec.path + ": expected at most " + std::to_string(kMostAtoms) +
                     " atoms, found " + std::to_string(records.size()));
  refuse_traces(records, spec.path);
  refuse_one_point(records, spec.path);
  const auto guessed = std::count_if(records.begin(), records.end(),
                                     [](const AtomRecord& r) { return r.element_guessed; });
  if (guessed > 0)
    result.decisions.push_back(
        "took the element of " + counted(guessed, "atom") +
        " from the atom name: the element column is empty or contradicts it");

  const Eigen::Matrix3Xd positions =
      molecules::read_positions_with_openmm(spec.path, records, format);
  result.molecule.path = spec.path;
  result.molecule.atoms.reserve(records.size());
  for (std::size_t i = 0; i < records.size(); ++i) {
    records[i].atom.position = positions.col(static_cast<Eigen::Index>(i));
    result.molecule.atoms.push_back(std::move(records[i].atom));
  }
  return result;
}

}  // namespace mortise
