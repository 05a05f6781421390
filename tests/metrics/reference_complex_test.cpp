// SPDX-License-Identifier: GPL-3.0-or-later
// Complex metrics: worked by hand, against the slow reference, and what must not change them.
#include "mortise/metrics/reference_complex.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "helpers/random_motions.hpp"
#include "metrics/bodies.hpp"
#include "mortise/core/errors.hpp"
#include "reference/slow_complex_metrics.hpp"

namespace mortise {
namespace {

using namespace testing_bodies;  // NOLINT: a test's own helpers
using tests::random_turn;

// Two triangles of CA atoms face to face, 4 apart along x; legs of 10, so that only equal corners
// touch.
const Molecule kFixed = calpha_chain("A", {{0, 0, 0}, {0, 10, 0}, {0, 0, 10}});
const Molecule kMoving = calpha_chain("B", {{4, 0, 0}, {4, 10, 0}, {4, 0, 10}});

RigidMotion shift(double x, double y, double z) {
  return {Eigen::Quaterniond::Identity(), {x, y, z}};
}

// i-RMSD and L-RMSD are roots of differences of large sums, good to 1e-10 A^2 (see
// paired_moments.cpp).
constexpr double kRmsdTolerance = 1e-5;

void expect_same(const ComplexMetrics& a, const ComplexMetrics& b) {
  EXPECT_NEAR(a.interface_rmsd, b.interface_rmsd, kRmsdTolerance);
  EXPECT_NEAR(a.ligand_rmsd, b.ligand_rmsd, kRmsdTolerance);
  EXPECT_DOUBLE_EQ(a.fnat, b.fnat);
  EXPECT_DOUBLE_EQ(a.fnonnat, b.fnonnat);
  EXPECT_NEAR(a.dockq, b.dockq, kRmsdTolerance);
  EXPECT_EQ(a.capri, b.capri);
}

TEST(ReferenceComplex, TheReferenceItselfIsPerfect) {
  const ReferenceComplex complex(kFixed, kMoving, kFixed, kMoving);
  const ComplexMetrics m = complex.evaluate({});
  EXPECT_NEAR(m.interface_rmsd, 0.0, kRmsdTolerance);
  EXPECT_NEAR(m.ligand_rmsd, 0.0, kRmsdTolerance);
  EXPECT_DOUBLE_EQ(m.fnat, 1.0);
  EXPECT_DOUBLE_EQ(m.fnonnat, 0.0);
  EXPECT_NEAR(m.dockq, 1.0, 1e-9);
  EXPECT_EQ(m.capri, CapriClass::kHigh);
  EXPECT_EQ(complex.summary().native_contacts, 3u);
  EXPECT_EQ(complex.summary().interface_residues, 6u);
}

TEST(ReferenceComplex, ShiftAlongTheNormalByHand) {
  const ReferenceComplex complex(kFixed, kMoving, kFixed, kMoving);
  // 0.6 further apart: every ligand atom is off by 0.6; superposed, all six by 0.3; contacts at 4.6
  // hold.
  const ComplexMetrics near = complex.evaluate(shift(0.6, 0, 0));
  EXPECT_NEAR(near.ligand_rmsd, 0.6, 1e-9);
  EXPECT_NEAR(near.interface_rmsd, 0.3, 1e-9);
  EXPECT_DOUBLE_EQ(near.fnat, 1.0);
  EXPECT_NEAR(near.dockq, (1.0 + 1.0 / 1.04 + 1.0 / (1.0 + 0.36 / 72.25)) / 3.0, 1e-9);
  // 1.5 further: contacts at 5.5 are gone, and with them the class.
  const ComplexMetrics far = complex.evaluate(shift(1.5, 0, 0));
  EXPECT_NEAR(far.interface_rmsd, 0.75, 1e-9);
  EXPECT_DOUBLE_EQ(far.fnat, 0.0);
  EXPECT_DOUBLE_EQ(far.fnonnat, 0.0);
  EXPECT_EQ(far.capri, CapriClass::kIncorrect);
  EXPECT_TRUE(far.is_hit());
}

TEST(ReferenceComplex, ExchangedCornersByHand) {
  const ReferenceComplex complex(kFixed, kMoving, kFixed, kMoving);
  // Half a turn about the diagonal through (4, 0, 0) exchanges the two far corners of the ligand,
  // 10 sqrt 2 apart.
  const Eigen::Quaterniond turn(
      Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d(0, 1, 1).normalized()));
  const Eigen::Vector3d pivot(4, 0, 0);
  const ComplexMetrics m = complex.evaluate({turn, pivot - turn * pivot});
  EXPECT_DOUBLE_EQ(m.fnat, 1.0 / 3.0);
  EXPECT_DOUBLE_EQ(m.fnonnat, 2.0 / 3.0);
  EXPECT_NEAR(m.ligand_rmsd, std::sqrt(2.0 * 200.0 / 3.0), 1e-9);
  // One step along y: the ligand's first corner meets the receptor's second one, nothing else
  // touches.
  const ComplexMetrics stepped = complex.evaluate(shift(0, 10, 0));
  EXPECT_DOUBLE_EQ(stepped.fnat, 0.0);
  EXPECT_DOUBLE_EQ(stepped.fnonnat, 1.0);
  EXPECT_NEAR(stepped.ligand_rmsd, 10.0, 1e-9);
}

TEST(ReferenceComplex, ContactsOfMissingResiduesStayInTheDenominator) {
  Molecule moving = kMoving;
  moving.atoms.pop_back();
  const ReferenceComplex complex(kFixed, moving, kFixed, kMoving);
  const ComplexMetrics m = complex.evaluate({});
  EXPECT_DOUBLE_EQ(m.fnat, 2.0 / 3.0);
  EXPECT_NEAR(m.interface_rmsd, 0.0, kRmsdTolerance);
  EXPECT_EQ(complex.summary().native_contacts_matched, 2u);
  EXPECT_EQ(complex.summary().interface_residues_matched, 5u);
  EXPECT_NEAR(complex.summary().moving.matched_fraction(), 2.0 / 3.0, 1e-15);
}

TEST(ReferenceComplex, HydrogensAndCofactorsMakeNoContact) {
  Molecule moving = kMoving;
  moving.atoms.insert(moving.atoms.begin() + 1, make_atom("HA", "ALA", "B", 1, {0.5, 10, 0}));
  Atom zinc = make_atom("ZN", "ZN", "B", 301, {1, 0, 10});
  zinc.hetero = true;
  moving.atoms.push_back(zinc);
  const ReferenceComplex complex(kFixed, moving, kFixed, moving);
  EXPECT_EQ(complex.summary().native_contacts, 3u);
  EXPECT_DOUBLE_EQ(complex.evaluate({}).fnonnat, 0.0);
}

TEST(ReferenceComplex, NucleicBackboneIsSugarAndPhosphate) {
  // One nucleotide against one CA: P and C4' are backbone, N9 is not; O1P is OP1's old name.
  Molecule dna;
  for (const auto& [name, at] :
       {std::pair("P", Eigen::Vector3d(4, 0, 0)), std::pair("O1P", Eigen::Vector3d(4, 1, 0)),
        std::pair("C4*", Eigen::Vector3d(5, 0, 1)), std::pair("C1*", Eigen::Vector3d(6, 0, 0)),
        std::pair("N9", Eigen::Vector3d(7, 0, 0))})
    dna.atoms.push_back(make_atom(name, "DA", "B", 1, at));
  Molecule bent = dna;
  bent.atoms[4].position.y() += 5.0;  // the base atom does not count
  bent.atoms[1].name = "OP1";
  bent.atoms[2].name = "C4'";
  bent.atoms[3].name = "C1'";
  const ReferenceComplex complex(kFixed, bent, kFixed, dna);
  EXPECT_NEAR(complex.evaluate({}).ligand_rmsd, 0.0, kRmsdTolerance);
  bent.atoms[1].position.y() += 2.0;  // OP1 does: one of four atoms off by 2
  EXPECT_NEAR(ReferenceComplex(kFixed, bent, kFixed, dna).evaluate({}).ligand_rmsd, 1.0, 1e-9);
}

struct Case {
  Molecule fixed, moving, reference_fixed, reference_moving;
};

// A made-up complex and a model of it with moved atoms and holes on either side, each body in
// another frame.
Case random_case(std::mt19937& random, int fixed_size, int moving_size, double sigma,
                 double holes) {
  Case c;
  const double radius = 2.7 * (std::cbrt(fixed_size) + std::cbrt(moving_size));
  c.reference_fixed = random_protein(random, "A", fixed_size, {10, 20, 30});
  c.reference_moving = random_protein(random, "B", moving_size, {10 + radius, 20, 30});
  c.fixed = thinned(random, jittered(random, c.reference_fixed, sigma), holes);
  c.moving = thinned(random, jittered(random, c.reference_moving, sigma), holes);
  c.reference_fixed = thinned(random, c.reference_fixed, holes);
  c.reference_moving = thinned(random, c.reference_moving, holes);
  c.fixed = moved(random_turn(random, 1.0, 30.0), c.fixed);
  c.moving = moved(random_turn(random, 2.0, 30.0), c.moving);
  return c;
}

// Poses from nearly right to far off.
std::vector<RigidMotion> poses_around(std::mt19937& random, const ReferenceComplex& complex,
                                      int count) {
  std::vector<RigidMotion> out;
  for (int i = 0; i < count; ++i) {
    const double size = std::pow(10.0, -2.0 + 3.0 * i / count);
    RigidMotion step = random_turn(random, std::min(3.0, 0.02 * size), 0.5 * size);
    out.push_back(compose(step, complex.superposed_pose()));
  }
  return out;
}

TEST(ReferenceComplex, AgreesWithTheSlowReferenceOnRandomBodies) {
  std::mt19937 random(42);
  int contacts_seen = 0;
  for (const auto& [fixed_size, moving_size] :
       {std::pair(12, 12), std::pair(60, 25), std::pair(40, 90)})
    for (const double sigma : {0.0, 0.5})
      for (const double holes : {0.0, 0.05})
        for (const LigandChoice choice : {LigandChoice::kMoving, LigandChoice::kSmaller}) {
          const Case c = random_case(random, fixed_size, moving_size, sigma, holes);
          ReferenceComplexOptions options;
          options.ligand = choice;
          const ReferenceComplex complex(c.fixed, c.moving, c.reference_fixed, c.reference_moving,
                                         options);
          if (choice == LigandChoice::kMoving) {
            EXPECT_TRUE(complex.summary().ligand_is_moving);
          } else if (fixed_size != moving_size) {
            EXPECT_EQ(complex.summary().ligand_is_moving, moving_size < fixed_size);
          }
          for (const RigidMotion& pose : poses_around(random, complex, 12)) {
            const ComplexMetrics slow =
                reference::complex_metrics(c.fixed, c.moving, c.reference_fixed, c.reference_moving,
                                           pose, complex.summary().ligand_is_moving);
            expect_same(complex.evaluate(pose), slow);
            contacts_seen += slow.fnat > 0.0 && slow.fnonnat > 0.0 ? 1 : 0;
          }
        }
  EXPECT_GT(contacts_seen, 50);  // the sweep reaches poses with right and wrong contacts
}

TEST(ReferenceComplex, CommonMotionsOfEitherSideChangeNothing) {
  std::mt19937 random(8);
  const Case c = random_case(random, 50, 30, 0.4, 0.02);
  const ReferenceComplex complex(c.fixed, c.moving, c.reference_fixed, c.reference_moving);
  const RigidMotion f = random_turn(random, 1.3, 50.0);
  const RigidMotion m = random_turn(random, 2.3, 50.0);
  const RigidMotion r = random_turn(random, 0.7, 50.0);
  const ReferenceComplex other(moved(f, c.fixed), moved(m, c.moving), moved(r, c.reference_fixed),
                               moved(r, c.reference_moving));
  for (const RigidMotion& pose : poses_around(random, complex, 20))
    expect_same(other.evaluate(compose(f, compose(pose, inverse(m)))), complex.evaluate(pose));
}

TEST(ReferenceComplex, SwappedBodiesAndReorderedFilesChangeNothing) {
  std::mt19937 random(9);
  const Case c = random_case(random, 50, 30, 0.4, 0.02);
  ReferenceComplexOptions options;
  options.ligand = LigandChoice::kSmaller;
  const ReferenceComplex complex(c.fixed, c.moving, c.reference_fixed, c.reference_moving, options);
  const ReferenceComplex swapped(c.moving, c.fixed, c.reference_moving, c.reference_fixed, options);
  Molecule backwards = c.reference_fixed;
  std::reverse(backwards.atoms.begin(), backwards.atoms.end());
  const ReferenceComplex reordered(c.fixed, c.moving, backwards, c.reference_moving, options);
  for (const RigidMotion& pose : poses_around(random, complex, 20)) {
    const ComplexMetrics expected = complex.evaluate(pose);
    expect_same(swapped.evaluate(inverse(pose)), expected);
    expect_same(reordered.evaluate(pose), expected);
  }
}

TEST(ReferenceComplex, SuperposedPoseOfARigidModelIsTheReference) {
  std::mt19937 random(10);
  const Case c = random_case(random, 40, 30, 0.0, 0.0);
  const ReferenceComplex complex(c.fixed, c.moving, c.reference_fixed, c.reference_moving);
  const ComplexMetrics m = complex.evaluate(complex.superposed_pose());
  EXPECT_NEAR(m.dockq, 1.0, 1e-9);
  EXPECT_DOUBLE_EQ(m.fnat, 1.0);
}

TEST(EvaluatePoses, GivesTheSameForAnyNumberOfThreads) {
  std::mt19937 random(11);
  const Case c = random_case(random, 40, 30, 0.5, 0.0);
  const ReferenceComplex complex(c.fixed, c.moving, c.reference_fixed, c.reference_moving);
  const auto poses = poses_around(random, complex, 300);
  const auto one = evaluate_poses(complex, poses, 1);
  const auto four = evaluate_poses(complex, poses, 4);
  ASSERT_EQ(one.size(), poses.size());
  ASSERT_EQ(four.size(), poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    EXPECT_EQ(one[i].interface_rmsd, four[i].interface_rmsd);
    EXPECT_EQ(one[i].ligand_rmsd, complex.evaluate(poses[i]).ligand_rmsd);
    EXPECT_EQ(one[i].fnat, four[i].fnat);
    EXPECT_EQ(one[i].dockq, four[i].dockq);
  }
  EXPECT_TRUE(evaluate_poses(complex, {}, 2).empty());
}

TEST(ReferenceComplex, RefusesWhatItCannotMeasure) {
  const Molecule away = moved(shift(100, 0, 0), kMoving);
  try {
    const ReferenceComplex complex(kFixed, kMoving, kFixed, away);
    FAIL() << "expected InputError";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), testing::HasSubstr("to touch"));
  }
  ReferenceComplexOptions options;
  options.contact_cutoff = std::nan("");
  EXPECT_THROW(ReferenceComplex(kFixed, kMoving, kFixed, kMoving, options), InputError);
  const ReferenceComplex complex(kFixed, kMoving, kFixed, kMoving);
  EXPECT_THROW((void)complex.evaluate({Eigen::Quaterniond(1, 1, 0, 0), {0, 0, 0}}), InputError);
  EXPECT_THROW((void)complex.evaluate(shift(std::nan(""), 0, 0)), InputError);
}

}  // namespace
}  // namespace mortise
