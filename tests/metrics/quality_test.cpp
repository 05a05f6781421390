// SPDX-License-Identifier: GPL-3.0-or-later
// DockQ and CAPRI classes against their published tables.
#include "mortise/metrics/quality.hpp"

#include <gtest/gtest.h>

namespace mortise {
namespace {

// The table as Lensink and Wodak (2010) print it, its rows in their order from the worst, each with
// all its bounds.
CapriClass printed_table(double fnat, double l, double i) {
  if (fnat < 0.1 || (l > 10.0 && i > 4.0)) return CapriClass::kIncorrect;
  if ((fnat < 0.3 && (l <= 10.0 || i <= 4.0)) || (fnat >= 0.3 && l > 5.0 && i > 2.0))
    return CapriClass::kAcceptable;
  if ((fnat < 0.5 && (l <= 5.0 || i <= 2.0)) || (fnat >= 0.5 && l > 1.0 && i > 1.0))
    return CapriClass::kMedium;
  return CapriClass::kHigh;
}

TEST(CapriClass, AgreesWithThePrintedTableAtAndAroundEveryBound) {
  for (const double fnat : {0.0, 0.0999, 0.1, 0.2, 0.2999, 0.3, 0.4, 0.4999, 0.5, 0.8, 1.0})
    for (const double l : {0.0, 1.0, 1.001, 3.0, 5.0, 5.001, 8.0, 10.0, 10.001, 30.0})
      for (const double i : {0.0, 1.0, 1.001, 1.5, 2.0, 2.001, 3.0, 4.0, 4.001, 20.0})
        EXPECT_EQ(capri_class(fnat, l, i), printed_table(fnat, l, i))
            << fnat << ' ' << l << ' ' << i;
}

TEST(CapriClass, OrdersAndNamesItsValues) {
  EXPECT_LT(CapriClass::kIncorrect, CapriClass::kAcceptable);
  EXPECT_LT(CapriClass::kMedium, CapriClass::kHigh);
  EXPECT_EQ(to_string(CapriClass::kIncorrect), "incorrect");
  EXPECT_EQ(to_string(CapriClass::kHigh), "high");
}

TEST(DockqScore, MatchesCasesWorkedByHand) {
  EXPECT_DOUBLE_EQ(dockq_score(1.0, 0.0, 0.0), 1.0);
  EXPECT_DOUBLE_EQ(dockq_score(0.5, 8.5, 1.5), 0.5);           // each term a half
  EXPECT_DOUBLE_EQ(dockq_score(0.2, 17.0, 3.0), 0.2);          // each term a fifth
  EXPECT_NEAR(dockq_score(0.533, 1.516, 1.197), 0.704, 5e-4);  // the example in DockQ's read-me
  EXPECT_NEAR(dockq_score(0.533, 1.516, 1.232), 0.700, 5e-4);  // and DockQ 2's
}

TEST(DockqClass, ChangesAtTheBands) {
  EXPECT_EQ(dockq_class(0.2299), CapriClass::kIncorrect);
  EXPECT_EQ(dockq_class(0.23), CapriClass::kAcceptable);
  EXPECT_EQ(dockq_class(0.4899), CapriClass::kAcceptable);
  EXPECT_EQ(dockq_class(0.49), CapriClass::kMedium);
  EXPECT_EQ(dockq_class(0.80), CapriClass::kHigh);
}

TEST(ComplexMetrics, HitAndAcceptableTakeTheirBounds) {
  ComplexMetrics m;
  m.interface_rmsd = 2.5;
  m.ligand_rmsd = 20.0;
  EXPECT_TRUE(m.is_hit());
  EXPECT_TRUE(m.is_acceptable_by_rmsd());
  EXPECT_FALSE(m.is_acceptable());  // its class says incorrect
  m.interface_rmsd = 4.001;
  EXPECT_FALSE(m.is_hit());
  EXPECT_FALSE(m.is_acceptable_by_rmsd());
  m.ligand_rmsd = 10.0;
  EXPECT_TRUE(m.is_acceptable_by_rmsd());
  m.capri = CapriClass::kAcceptable;
  EXPECT_TRUE(m.is_acceptable());
}

}  // namespace
}  // namespace mortise
