// SPDX-License-Identifier: GPL-3.0-or-later
// Molecules as knots: weights by hand, hydrogens dropped, radii, refusals.
#include "mortise/molecules/to_knots.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "metrics/bodies.hpp"
#include "mortise/core/errors.hpp"
#include "mortise/molecules/merge_buried.hpp"
#include "mortise/molecules/radii.hpp"

namespace mortise {
namespace {

using testing_bodies::make_atom;

// One lone atom of each kind, 20 apart: all exposed.
Molecule lone_atoms() {
  Molecule m;
  m.path = "lone.pdb";
  int n = 0;
  const auto add = [&](const char* name, const char* residue) {
    m.atoms.push_back(make_atom(name, residue, "A", n, {20.0 * n, 1.0, 2.0}));
    ++n;
  };
  add("CB", "TRP");
  add("N", "TRP");
  add("CA", "TRP");
  add("C", "TRP");
  add("O", "TRP");
  add("H", "TRP");
  add("SD", "MSE");
  add("CD", "LYS");
  add("OXT", "ASP");
  add("C1", "HEM");
  return m;
}

// Twelve atoms around the origin, at the corners of an icosahedron.
void add_shell(Molecule& molecule, const std::string& name, int residue) {
  const double g = 0.5 * (1.0 + std::sqrt(5.0));
  for (const double a : {-1.0, 1.0})
    for (const double b : {-g, g})
      for (int turn = 0; turn < 3; ++turn) {
        Eigen::Vector3d p(0.0, a, b);
        std::rotate(p.data(), p.data() + turn, p.data() + 3);
        molecule.atoms.push_back(make_atom(name, "PHE", "A", residue, 1.5 * p));
      }
}

TEST(ToKnots, WeightsByHand) {
  Molecule m = lone_atoms();
  m.atoms[8].element = "O";
  const Knots knots = to_knots(m, {.radius = 1.8, .propensity = 0.5});
  ASSERT_EQ(knots.size(), 9);  // the hydrogen is gone, the order is kept
  // Exposed side chains 1 + 0.5 p; backbone and hetero groups 1. A chain's end (OXT) is backbone.
  const std::vector<double> expected = {1 + 0.5 * 0.83, 1, 1, 1, 1, 1 + 0.5 * 0.66,
                                        1 - 0.5 * 0.36, 1, 1};
  const std::vector<double> x = {0, 20, 40, 60, 80, 120, 140, 160, 180};
  for (Eigen::Index i = 0; i < 9; ++i) {
    EXPECT_DOUBLE_EQ(knots.weights[i].real(), expected[i]) << i;
    EXPECT_EQ(knots.weights[i].imag(), 0.0);
    EXPECT_EQ(knots.points.col(i), Eigen::Vector4d(x[i], 1.0, 2.0, 1.8)) << i;
  }
}

TEST(ToKnots, PropensityZeroMakesAllWeightsOne) {
  const Knots knots = to_knots(lone_atoms(), {.propensity = 0.0});
  EXPECT_TRUE((knots.weights.array() == std::complex<double>(1.0)).all());
}

TEST(ToKnots, RadiusZeroTakesEachAtomsOwn) {
  const Molecule m = lone_atoms();
  const Knots knots = to_knots(m, {.radius = 0.0});
  for (Eigen::Index i = 0; i < knots.size(); ++i)
    EXPECT_EQ(knots.points(3, i), atom_radius(m.atoms[i < 5 ? i : i + 1]));
  EXPECT_NE(knots.points(3, 0), knots.points(3, 1));
}

TEST(ToKnots, MergesBuriedAtomsWhereAsked) {
  // 7^3 carbons 1.9 apart: the middle is deep enough for balls of 4.
  Molecule m;
  int n = 0;
  for (int i = -3; i <= 3; ++i)
    for (int j = -3; j <= 3; ++j)
      for (int k = -3; k <= 3; ++k)
        m.atoms.push_back(make_atom("CB", "ALA", "A", n++, {1.9 * i, 1.9 * j, 1.9 * k}));
  const Knots plain = to_knots(m), merged = to_knots(m, {.merge_buried = 4.0});
  const Knots by_hand = merge_buried(plain, {.largest = 4.0});
  EXPECT_LT(merged.size(), plain.size());
  EXPECT_EQ(merged.points, by_hand.points);
  EXPECT_EQ(merged.weights, by_hand.weights);
  EXPECT_NE(to_knots(m, {.merge_buried = 4.0, .offset = 2.0}).weights, merged.weights);
  EXPECT_THROW((void)to_knots(m, {.merge_buried = -1.0}), InputError);
  EXPECT_THROW((void)to_knots(m, {.merge_buried = std::nan("")}), InputError);
}

TEST(ToKnots, BuriedSideChainsWeighOne) {
  // A side-chain atom in a shell of twelve others, so close that no probe gets in.
  Molecule m;
  m.atoms.push_back(make_atom("CB", "PHE", "A", 1, {0, 0, 0}));
  add_shell(m, "CG", 2);
  const Knots knots = to_knots(m, {.propensity = 1.0});
  EXPECT_EQ(knots.weights[0].real(), 1.0);
  for (Eigen::Index i = 1; i < 13; ++i) EXPECT_DOUBLE_EQ(knots.weights[i].real(), 1.82);
  // Where the line between buried and exposed is drawn is an option.
  const Knots none = to_knots(m, {.propensity = 1.0, .exposed_area = 1000.0});
  EXPECT_TRUE((none.weights.array() == std::complex<double>(1.0)).all());
}

TEST(ToKnots, HydrogensShieldNothing) {
  // United radii stand for the hydrogens: a molecule with and without them has the same knots.
  Molecule bare, full;
  bare.atoms.push_back(make_atom("CB", "PHE", "A", 1, {0, 0, 0}));
  full = bare;
  add_shell(full, "HB", 1);
  EXPECT_EQ(to_knots(full).weights, to_knots(bare).weights);
}

TEST(InterfacePropensity, TwentyAminoAcidsAndNoOthers) {
  const std::map<std::string, double> table = {
      {"ALA", -0.17}, {"ARG", 0.27},  {"ASN", 0.12},  {"ASP", -0.38}, {"CYS", 0.43},
      {"GLN", -0.11}, {"GLU", -0.13}, {"GLY", -0.07}, {"HIS", 0.41},  {"ILE", 0.44},
      {"LEU", 0.40},  {"LYS", -0.36}, {"MET", 0.66},  {"PHE", 0.82},  {"PRO", -0.25},
      {"SER", -0.33}, {"THR", -0.18}, {"TRP", 0.83},  {"TYR", 0.66},  {"VAL", 0.27}};
  EXPECT_EQ(table.size(), 20U);
  for (const auto& [name, value] : table) EXPECT_EQ(interface_propensity(name), value) << name;
  EXPECT_EQ(interface_propensity("MSE"), interface_propensity("MET"));
  for (const char* other : {"", "HOH", "HEM", "A", "ala", "ALAX"})
    EXPECT_EQ(interface_propensity(other), 0.0) << other;
}

TEST(ToKnots, RefusesBadInput) {
  Molecule hydrogens;
  hydrogens.path = "water.pdb";
  hydrogens.atoms.push_back(make_atom("H", "ALA", "A", 1, {0, 0, 0}));
  EXPECT_THROW((void)to_knots(hydrogens), InputError);
  EXPECT_THROW((void)to_knots({}), InputError);
  const Molecule good = lone_atoms();
  const double nan = std::nan("");
  for (const double bad : {-1.0, nan}) {
    EXPECT_THROW((void)to_knots(good, {.radius = bad}), InputError);
    EXPECT_THROW((void)to_knots(good, {.propensity = bad}), InputError);
    EXPECT_THROW((void)to_knots(good, {.exposed_area = bad}), InputError);
  }
  EXPECT_THROW((void)to_knots(good, {.threads = -1}), InputError);
}

}  // namespace
}  // namespace mortise
