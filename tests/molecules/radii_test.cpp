// SPDX-License-Identifier: GPL-3.0-or-later
// Radii of atoms, spot checks of the published values.
#include "mortise/molecules/radii.hpp"

#include <gtest/gtest.h>

#include "mortise/molecules/read_molecule.hpp"

namespace mortise {
namespace {

double radius(const char* residue, const char* name, const char* element, bool hetero = false) {
  Atom atom;
  atom.residue_name = residue;
  atom.name = name;
  atom.element = element;
  atom.hetero = hetero;
  return atom_radius(atom);
}

TEST(AtomRadius, FollowsTheProtOrClasses) {
  EXPECT_EQ(radius("ALA", "C", "C"), 1.61);
  EXPECT_EQ(radius("ALA", "CA", "C"), 1.88);
  EXPECT_EQ(radius("GLY", "CA", "C"), 1.88);
  EXPECT_EQ(radius("ALA", "CB", "C"), 1.88);
  EXPECT_EQ(radius("ALA", "N", "N"), 1.64);
  EXPECT_EQ(radius("LYS", "NZ", "N"), 1.64);
  EXPECT_EQ(radius("ALA", "O", "O"), 1.42);
  EXPECT_EQ(radius("ALA", "OXT", "O"), 1.42);
  EXPECT_EQ(radius("GLU", "OE2", "O"), 1.42);
  EXPECT_EQ(radius("SER", "OG", "O"), 1.46);
  EXPECT_EQ(radius("THR", "OG1", "O"), 1.46);
  EXPECT_EQ(radius("TYR", "OH", "O"), 1.46);
  EXPECT_EQ(radius("CYS", "SG", "S"), 1.77);
  EXPECT_EQ(radius("MET", "SD", "S"), 1.77);
  EXPECT_EQ(radius("PHE", "CG", "C"), 1.61);
  EXPECT_EQ(radius("PHE", "CZ", "C"), 1.76);
  EXPECT_EQ(radius("TYR", "CZ", "C"), 1.61);
  EXPECT_EQ(radius("TYR", "CE2", "C"), 1.76);
  EXPECT_EQ(radius("TRP", "CD1", "C"), 1.76);
  EXPECT_EQ(radius("TRP", "CD2", "C"), 1.61);
  EXPECT_EQ(radius("HIS", "CD2", "C"), 1.76);
  EXPECT_EQ(radius("HSD", "CG", "C"), 1.61);
  EXPECT_EQ(radius("ARG", "CZ", "C"), 1.61);
  EXPECT_EQ(radius("ARG", "CG", "C"), 1.88);
  EXPECT_EQ(radius("LEU", "CD1", "C"), 1.88);
  EXPECT_EQ(radius("GLN", "CD", "C"), 1.61);
}

TEST(AtomRadius, FallsBackToTheElement) {
  EXPECT_EQ(radius("DA", "C5'", "C"), 1.70);
  EXPECT_EQ(radius("G", "P", "P"), 1.80);
  EXPECT_EQ(radius("MSE", "SE", "Se"), 1.90);
  EXPECT_EQ(radius("ZN", "ZN", "Zn", true), 1.39);
  EXPECT_EQ(radius("FE", "FE", "Fe", true), 2.0);
  EXPECT_EQ(radius("ALA", "X", ""), 2.0);
}

TEST(AtomRadii, OnePerAtom) {
  const Molecule molecule =
      read_molecule({.path = std::string(MORTISE_SOURCE_DIR) + "/molecules/1hpv_ligand.pdb"})
          .molecule;
  const Eigen::VectorXd radii = atom_radii(molecule);
  ASSERT_EQ(radii.size(), 758);
  EXPECT_EQ(radii.minCoeff(), 1.42);
  EXPECT_EQ(radii.maxCoeff(), 1.88);
  EXPECT_EQ(atom_positions(molecule).col(5), molecule.atoms[5].position);
}

}  // namespace
}  // namespace mortise
