// SPDX-License-Identifier: GPL-3.0-or-later
// Atom records as they stand in a structure file, checked and with their lines, before OpenMM reads
// them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "mortise/molecules/molecule.hpp"

namespace mortise::molecules {

enum class Format { kPdb, kMmcif };

/// One ATOM or HETATM record.
struct AtomRecord {
  Atom atom;                        ///< position as this scan reads it; OpenMM's replaces it
  std::string_view source;          ///< PDB: its line, into the file's text
  std::string_view coordinates[3];  ///< the numbers as written, into the file's text
  std::string alternate;            ///< alternate location; empty if none
  int model = 1;
  long line = 0;                 ///< 1-based
  bool element_guessed = false;  ///< the element comes from the atom name
  bool repeated_name = false;    ///< an earlier atom of the residue has the same name
};

/// A whole file's text, unpacked if it is gzip. @throws FileError
[[nodiscard]] std::string read_text(const std::string& path);

/// PDB or mmCIF, told by content; refuses HTML, XML and binary data. @throws FileError
[[nodiscard]] Format detect_format(const std::string& path, std::string_view text);

/// All atom records of a file. @throws FileError
[[nodiscard]] std::vector<AtomRecord> scan_pdb(const std::string& path, std::string_view text);
[[nodiscard]] std::vector<AtomRecord> scan_mmcif(const std::string& path, std::string_view text);

/// Parses a coordinate and checks that it is finite and below 9,999 in size. @throws FileError
[[nodiscard]] double parse_coordinate(std::string_view text, char axis, const std::string& path,
                                      long line);

/// `text` without blanks at its ends.
[[nodiscard]] std::string_view trim(std::string_view text);

}  // namespace mortise::molecules
