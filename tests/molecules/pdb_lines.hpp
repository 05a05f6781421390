// SPDX-License-Identifier: GPL-3.0-or-later
// PDB lines to fill a file with.
#pragma once

#include <cstdio>
#include <string>

namespace mortise::test {

struct PdbLine {
  const char* record = "ATOM";
  const char* serial = "1";
  const char* name = " CA ";  ///< the four columns
  const char* alternate = " ";
  const char* residue = "ALA";
  const char* chain = "A";
  const char* number = "1";
  const char* insertion = " ";
  double x = 0, y = 0, z = 0;
  const char* element = "";
};

inline std::string pdb_line(const PdbLine& a) {
  char text[128];
  std::snprintf(text, sizeof text,
                "%-6s%5s %4s%1s%3s %1s%4s%1s   %8.3f%8.3f%8.3f  1.00  0.00          %2s\n",
                a.record, a.serial, a.name, a.alternate, a.residue, a.chain, a.number, a.insertion,
                a.x, a.y, a.z, a.element);
  return text;
}

/// N, CA, C, O of one alanine at x.
inline std::string backbone(const char* chain, const char* number, double x,
                            const char* residue = "ALA", const char* insertion = " ") {
  std::string text;
  double y = 0;
  for (const char* name : {" N  ", " CA ", " C  ", " O  "})
    text += pdb_line({.name = name,
                      .residue = residue,
                      .chain = chain,
                      .number = number,
                      .insertion = insertion,
                      .x = x,
                      .y = y += 1.4});
  return text;
}

}  // namespace mortise::test
