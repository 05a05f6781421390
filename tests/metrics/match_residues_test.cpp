// SPDX-License-Identifier: GPL-3.0-or-later
// Residue matching: by number, by alignment, across chain names, and refusals.
#include "mortise/metrics/match_residues.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "helpers/random_motions.hpp"
#include "metrics/bodies.hpp"
#include "mortise/core/errors.hpp"

namespace mortise {
namespace {

using namespace testing_bodies;  // NOLINT: a test's own helpers
using tests::random_turn;

Molecule joined(Molecule a, const Molecule& b) {
  a.atoms.insert(a.atoms.end(), b.atoms.begin(), b.atoms.end());
  return a;
}

Molecule renamed(Molecule m, const std::string& chain) {
  for (Atom& a : m.atoms) a.chain = chain;
  return m;
}

Molecule renumbered(Molecule m, int step) {
  for (Atom& a : m.atoms) a.residue_number += step;
  return m;
}

Molecule without_residues(const Molecule& m, int first, int last) {
  Molecule out;
  for (const Atom& a : m.atoms)
    if (a.residue_number < first || a.residue_number > last) out.atoms.push_back(a);
  return out;
}

// Every pair must join residues at the same place: the tests' molecules are not deformed.
void expect_same_places(const Molecule& model, const Molecule& reference,
                        const ResidueMatch& match) {
  const auto a = residues(model);
  const auto b = residues(reference);
  for (const auto& [i, j] : match.pairs)
    EXPECT_EQ(model.atoms[a[i].first].position, reference.atoms[b[j].first].position);
}

TEST(MatchResidues, PairsByNumberAndInsertionCodeAcrossGaps) {
  std::mt19937 random(1);
  Molecule reference = random_protein(random, "A", 40, Eigen::Vector3d::Zero());
  for (Atom& a : reference.atoms)
    if (a.residue_number == 21) {
      a.residue_number = 20;
      a.insertion_code = "A";
    }
  const Molecule model = without_residues(reference, 5, 8);
  const ResidueMatch match = match_residues(model, reference);
  EXPECT_EQ(match.pairs.size(), 36u);
  EXPECT_DOUBLE_EQ(match.matched_fraction(), 0.9);
  ASSERT_EQ(match.chains.size(), 1u);
  EXPECT_EQ(match.chains[0].method, MatchMethod::kNumbering);
  EXPECT_EQ(match.chains[0].identical, 36u);
  expect_same_places(model, reference, match);
}

TEST(MatchResidues, AlignsWhereNumbersDisagreeAndTakesMseForMet) {
  std::mt19937 random(2);
  const Molecule reference = random_protein(random, "A", 60, Eigen::Vector3d::Zero());
  Molecule model = renumbered(without_residues(reference, 20, 24), 100);
  for (Atom& a : model.atoms)
    if (a.residue_name == "MSE") a.residue_name = "MET";
  const ResidueMatch match = match_residues(model, reference);
  ASSERT_EQ(match.chains.size(), 1u);
  EXPECT_EQ(match.chains[0].method, MatchMethod::kAlignment);
  // At the ends of the gap the alignment may slide over equal residues: 55 pairs in any case.
  EXPECT_EQ(match.pairs.size(), 55u);
}

TEST(MatchResidues, DistrustsNumbersThatPairDifferentResidues) {
  std::mt19937 random(3);
  const Molecule reference = random_protein(random, "A", 60, Eigen::Vector3d::Zero());
  const Molecule model = renumbered(reference, 3);  // 57 numbers in common, all wrong
  const ResidueMatch match = match_residues(model, reference);
  EXPECT_EQ(match.chains[0].method, MatchMethod::kAlignment);
  EXPECT_EQ(match.pairs.size(), 60u);
  expect_same_places(model, reference, match);
}

TEST(MatchResidues, FindsChainsUnderOtherNames) {
  std::mt19937 random(4);
  const Molecule first = random_protein(random, "A", 50, {0, 0, 0});
  const Molecule second = random_protein(random, "B", 30, {40, 0, 0});
  const Molecule reference = joined(first, second);
  // The same names, exchanged: names alone would mislead.
  const Molecule model = joined(renamed(first, "B"), renamed(second, "A"));
  const ResidueMatch match = match_residues(model, reference);
  EXPECT_EQ(match.pairs.size(), 80u);
  expect_same_places(model, reference, match);
  const Molecule others = joined(renamed(second, "X"), renamed(first, ""));
  const ResidueMatch again = match_residues(others, reference);
  EXPECT_EQ(again.pairs.size(), 80u);
  expect_same_places(others, reference, again);
}

TEST(MatchResidues, PutsEquivalentChainsWhereTheySuperpose) {
  std::mt19937 random(5);
  // Three copies of one chain, placed without symmetry; the model lists them in another order under
  // other names.
  const Molecule chain = random_protein(random, "A", 30, Eigen::Vector3d::Zero());
  const Molecule a = chain;
  const Molecule b = renamed(moved(random_turn(random, 1.0, 30.0), chain), "B");
  const Molecule c = renamed(moved(random_turn(random, 2.0, 30.0), chain), "C");
  const Molecule reference = joined(joined(a, b), c);
  const Molecule model = joined(joined(renamed(c, "1"), renamed(a, "2")), renamed(b, "3"));
  const ResidueMatch match = match_residues(model, reference);
  EXPECT_EQ(match.pairs.size(), 90u);
  expect_same_places(model, reference, match);
}

TEST(MatchResidues, LeavesOutCofactorsAndKeepsBondedModifiedResidues) {
  Molecule m;
  for (int i = 0; i < 3;
       ++i) {  // a straight peptide: N, CA, C 1.4 apart, bonds of 1.4 between residues
    const double x = 4.2 * i;
    for (const auto& [name, at] :
         {std::pair("N", x), std::pair("CA", x + 1.4), std::pair("C", x + 2.8)}) {
      m.atoms.push_back(make_atom(name, i == 1 ? "MSE" : "ALA", "A", i + 1, {at, 0, 0}));
      m.atoms.back().hetero = i == 1;
    }
  }
  Molecule with_ligands = m;
  for (const char* name : {"N", "CA", "C", "O"}) {  // a free amino acid
    with_ligands.atoms.push_back(make_atom(name, "GLU", "A", 501, {50, 0, 0}));
    with_ligands.atoms.back().hetero = true;
  }
  for (const char* name : {"PG", "O3'", "C4'", "C1'"}) {  // ATP
    with_ligands.atoms.push_back(make_atom(name, "ATP", "A", 502, {60, 0, 0}));
    with_ligands.atoms.back().hetero = true;
  }
  const ResidueMatch match = match_residues(with_ligands, m);
  EXPECT_EQ(match.model_residues, 3u);
  EXPECT_EQ(match.pairs.size(), 3u);
}

TEST(MatchResidues, RefusesStrangersWithBothSidesNamed) {
  Molecule a = calpha_chain("A", std::vector<Eigen::Vector3d>(30, Eigen::Vector3d::Zero()));
  Molecule b = a;
  a.path = "model.pdb";
  b.path = "reference.pdb";
  for (Atom& atom : b.atoms) atom.residue_name = "GLY";
  try {
    (void)match_residues(a, b);
    FAIL() << "expected InputError";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), testing::HasSubstr("model.pdb [chain 'A' 30 residues]"));
    EXPECT_THAT(e.what(), testing::HasSubstr("reference.pdb [chain 'A' 30 residues]"));
    EXPECT_THAT(e.what(), testing::HasSubstr("expected 15 or more residues in common, found 0"));
  }
  EXPECT_THROW((void)match_residues(a, Molecule{}), InputError);
  MatchResiduesOptions options;
  options.min_fraction = 1.5;
  EXPECT_THROW((void)match_residues(a, a, options), InputError);
}

TEST(MatchResidues, AsksForTheFractionOfTheSmallerSide) {
  std::mt19937 random(6);
  const Molecule big = joined(random_protein(random, "A", 40, {0, 0, 0}),
                              random_protein(random, "B", 40, {40, 0, 0}));
  const Molecule part = renamed(without_residues(big, 21, 40), "C");  // two halves in one chain
  EXPECT_NO_THROW((void)match_residues(without_residues(big, 1, 20), big));
  MatchResiduesOptions strict;
  strict.min_fraction = 0.9;
  EXPECT_THROW((void)match_residues(part, big, strict), InputError);  // one half is found only
}

}  // namespace
}  // namespace mortise
