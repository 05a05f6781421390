// SPDX-License-Identifier: GPL-3.0-or-later
// Residues of a molecule, and the parsing of "path#model:chains".
#include "mortise/molecules/molecule.hpp"

#include <charconv>
#include <filesystem>

#include "mortise/core/errors.hpp"
#include "mortise/molecules/read_molecule.hpp"

namespace mortise {

std::vector<ResidueRange> residues(const Molecule& molecule) {
  std::vector<ResidueRange> ranges;
  const auto& atoms = molecule.atoms;
  for (std::size_t i = 0; i < atoms.size(); ++i) {
    const bool same = i > 0 && atoms[i].residue_number == atoms[i - 1].residue_number &&
                      atoms[i].chain == atoms[i - 1].chain &&
                      atoms[i].insertion_code == atoms[i - 1].insertion_code &&
                      atoms[i].residue_name == atoms[i - 1].residue_name;
    if (!same) ranges.push_back({i, i});
    ranges.back().last = i + 1;
  }
  return ranges;
}

MoleculeSpec parse_molecule_spec(const std::string& text) {
  MoleculeSpec spec;
  spec.path = text;
  std::error_code ignored;
  if (std::filesystem::exists(text, ignored)) return spec;
  const std::string expected = "'" + text + "': expected PATH[#MODEL][:CHAIN,CHAIN], found ";
  const std::size_t slash = spec.path.rfind('/');
  const std::size_t base = slash == std::string::npos ? 0 : slash + 1;
  const std::size_t colon = spec.path.find(':', base);
  if (colon != std::string::npos) {
    std::string list = spec.path.substr(colon + 1);
    spec.path.resize(colon);
    for (std::size_t at = 0;;) {
      const std::size_t comma = list.find(',', at);
      spec.chains.push_back(list.substr(at, comma == std::string::npos ? comma : comma - at));
      if (spec.chains.back().empty()) throw InputError(expected + "an empty chain name");
      if (comma == std::string::npos) break;
      at = comma + 1;
    }
  }
  // A '#' may be part of the file's name: it starts a model only if no such file exists.
  const std::size_t hash = spec.path.find('#', base);
  if (hash != std::string::npos && !std::filesystem::exists(spec.path, ignored)) {
    const std::string number = spec.path.substr(hash + 1);
    const char* end = number.data() + number.size();
    const auto [stop, error] = std::from_chars(number.data(), end, spec.model);
    if (error != std::errc() || stop != end || spec.model < 1)
      throw InputError(expected + "model '" + number + "', not a positive number");
    spec.path.resize(hash);
  }
  if (spec.path.empty()) throw InputError(expected + "no path");
  return spec;
}

}  // namespace mortise
