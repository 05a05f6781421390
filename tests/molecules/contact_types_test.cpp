// SPDX-License-Identifier: GPL-3.0-or-later
// Types of atoms, by hand for one atom of each kind.
#include "mortise/molecules/contact_types.hpp"

#include <gtest/gtest.h>

#include <set>

namespace mortise {
namespace {

int type_of(const char* residue, const char* name, const char* element) {
  Atom atom;
  atom.residue_name = residue;
  atom.name = name;
  atom.element = element;
  return contact_type(atom);
}

TEST(ContactTypes, OneAtomOfEachKind) {
  struct Case {
    const char *residue, *name, *element;
    int type;
  };
  const Case cases[] = {
      {"ALA", "N", "N", 0},    {"SER", "CA", "C", 1},   {"VAL", "C", "C", 2},
      {"LEU", "O", "O", 3},    {"GLY", "OXT", "O", 3},  {"GLY", "CA", "C", 4},
      {"LYS", "CG", "C", 5},   {"PRO", "CD", "C", 5},   {"SER", "CB", "C", 5},
      {"ALA", "CB", "C", 6},   {"LYS", "NZ", "N", 7},   {"LYS", "CE", "C", 8},
      {"ARG", "CD", "C", 8},   {"ARG", "CZ", "C", 9},   {"ARG", "NH2", "N", 10},
      {"GLU", "OE1", "O", 11}, {"ASP", "CG", "C", 12},  {"GLU", "CD", "C", 12},
      {"GLU", "CG", "C", 5},   {"ASN", "OD1", "O", 13}, {"GLN", "NE2", "N", 14},
      {"ASN", "CG", "C", 14},  {"THR", "OG1", "O", 15}, {"TYR", "OH", "O", 15},
      {"HIS", "ND1", "N", 16}, {"TYR", "CZ", "C", 17},  {"PHE", "CZ", "C", 18},
      {"TRP", "NE1", "N", 19}, {"MET", "SD", "S", 20},  {"MSE", "SE", "Se", 20},
      {"CYS", "SG", "S", 20},  {"ILE", "CD1", "C", 21}, {"LEU", "CG", "C", 21},
  };
  std::set<int> seen;
  for (const Case& c : cases) {
    EXPECT_EQ(type_of(c.residue, c.name, c.element), c.type) << c.residue << " " << c.name;
    seen.insert(c.type);
  }
  EXPECT_EQ(seen.size(), static_cast<std::size_t>(kContactTypes));
  EXPECT_EQ(type_of("HOH", "O", "O"), -1);
  EXPECT_EQ(type_of("ATP", "C5", "C"), -1);
  EXPECT_EQ(type_of("ALA", "HB1", "H"), -1);
}

}  // namespace
}  // namespace mortise
