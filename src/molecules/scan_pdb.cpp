// SPDX-License-Identifier: GPL-3.0-or-later
// Atom records of the PDB format, version 3.3, by columns.
#include <charconv>
#include <optional>

#include "molecules/atom_records.hpp"
#include "molecules/hybrid36.hpp"
#include "molecules/residue_kinds.hpp"
#include "mortise/core/errors.hpp"

namespace mortise::molecules {
namespace {

std::optional<int> parse_int(std::string_view text, int base = 10) {
  int value = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value, base);
  if (text.empty() || error != std::errc() || stop != text.data() + text.size()) return {};
  return value;
}

/// Decimal or hybrid-36; hexadecimal where it is neither ("27AF", from programs that count so).
std::optional<int> parse_residue_number(std::string_view field) {
  const auto value = decode_hybrid36(field, 4);
  return value ? value : parse_int(field, 16);
}

AtomRecord parse_atom(std::string_view line, const std::string& path, long number,
                      const AtomRecord* previous) {
  if (line.size() < 54)
    throw FileError(path, number,
                    "atom record cut off: expected coordinates up to column 54, found " +
                        std::to_string(line.size()) + " columns");
  AtomRecord record;
  record.line = number;
  record.source = line;
  Atom& atom = record.atom;
  const std::string_view name_columns = line.substr(12, 4);
  atom.name = trim(name_columns);
  atom.residue_name =
      trim(line.substr(17, 4));  // column 21 holds the fourth letter of some programs
  atom.chain = trim(line.substr(21, 1));
  atom.insertion_code = trim(line.substr(26, 1));
  record.alternate = trim(line.substr(16, 1));
  if (atom.name.empty())
    throw FileError(path, number, "columns 13-16: expected an atom name, found blanks");
  const std::string_view number_columns = trim(line.substr(22, 4));
  if (const auto value = parse_residue_number(number_columns)) {
    atom.residue_number = *value;
  } else if (number_columns == "****" && previous != nullptr) {
    // Overflow: count on. A new residue starts with another name or with the atom name the last one
    // began with.
    const bool same = previous->atom.residue_name == atom.residue_name && atom.name != "N";
    atom.residue_number = previous->atom.residue_number + (same ? 0 : 1);
  } else {
    throw FileError(path, number,
                    "columns 23-26: expected a residue number, found '" +
                        std::string(line.substr(22, 4)) + "'");
  }
  for (int axis = 0; axis < 3; ++axis) {
    record.coordinates[axis] = line.substr(30 + 8 * axis, 8);
    atom.position[axis] = parse_coordinate(record.coordinates[axis], "xyz"[axis], path, number);
  }
  std::string column_element;
  if (line.size() >= 78) column_element = element_symbol(trim(line.substr(76, 2)));
  if (!column_element.empty() && element_fits_name(column_element, atom.name, atom.residue_name)) {
    atom.element = column_element;
  } else {
    atom.element = element_from_name(name_columns, atom.residue_name);
    record.element_guessed = true;
  }
  return record;
}

}  // namespace

std::vector<AtomRecord> scan_pdb(const std::string& path, std::string_view text) {
  std::vector<AtomRecord> records;
  records.reserve(text.size() / 82 + 1);
  long number = 0;
  int model = 1;
  bool atoms_in_model = false;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    std::string_view line = text.substr(at, end - at);
    at = end + 1;
    ++number;
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    if (line.starts_with("ATOM  ") || line.starts_with("HETATM")) {
      records.push_back(
          parse_atom(line, path, number, records.empty() ? nullptr : &records.back()));
      records.back().model = model;
      atoms_in_model = true;
    } else if (line.starts_with("MODEL ")) {
      const auto value = parse_int(trim(line.substr(6)));
      if (!value)
        throw FileError(
            path, number,
            "MODEL record: expected a number, found '" + std::string(trim(line.substr(6))) + "'");
      model = *value;
      atoms_in_model = false;
    } else if (line.starts_with("ENDMDL") && atoms_in_model) {
      ++model;  // a MODEL record that follows says the same or better
      atoms_in_model = false;
    } else if (line == "ATOM" || line == "HETAT" || line == "HETA") {
      throw FileError(path, number, "atom record cut off after '" + std::string(line) + "'");
    }
  }
  return records;
}

}  // namespace mortise::molecules
