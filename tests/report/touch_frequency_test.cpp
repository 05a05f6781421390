// SPDX-License-Identifier: GPL-3.0-or-later
// How often places are touched, against all pairs of points.
#include <gtest/gtest.h>

#include <set>

#include "mortise/core/errors.hpp"
#include "mortise/report/page.hpp"
#include "sample_report.hpp"

namespace mortise::testing {
namespace {

TEST(TouchFrequency, AgreesWithAllPairsOfAtoms) {
  const ReportBodies bodies = protease();
  const mortise::Run run = report_run(bodies, 12);
  const Molecule& fixed = bodies.fixed.molecule;
  const std::vector<ResidueRange> all = residues(fixed);
  for (const double cutoff : {3.5, 5.0, 12.0}) {
    Eigen::VectorXd expected = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(all.size()));
    constexpr int kPoses = 8;
    for (int p = 0; p < kPoses; ++p)
      for (std::size_t r = 0; r < all.size(); ++r) {
        bool touched = false;
        for (std::size_t i = all[r].first; i < all[r].last && !touched; ++i)
          for (const Atom& atom : bodies.moving.molecule.atoms)
            touched = touched || (run.poses.poses[static_cast<std::size_t>(p)].moving_in_fixed *
                                      atom.position -
                                  fixed.atoms[i].position)
                                         .norm() < cutoff;
        expected[static_cast<Eigen::Index>(r)] += touched ? 1.0 / kPoses : 0.0;
      }
    ASSERT_GT(expected.maxCoeff(), 0.0);
    for (const int threads : {1, 3})
      EXPECT_TRUE(touch_frequency(run, bodies, cutoff, kPoses, threads).isApprox(expected, 1e-12))
          << cutoff;
  }
}

TEST(TouchFrequency, OfPartsIsPerVertex) {
  const ReportBodies bodies = plate_and_pin();
  mortise::Run run = report_run(bodies, 1);
  run.poses.poses[0].moving_in_fixed = {};
  const Eigen::VectorXd frequency = touch_frequency(run, bodies, 1.0, 1);
  ASSERT_EQ(frequency.size(), bodies.fixed.mesh.vertices.cols());
  // The pin touches the rim of the hole at the top, not the plate's outer corners.
  EXPECT_EQ(frequency[2 * 48], 1.0);
  EXPECT_EQ(frequency[0], 0.0);
}

TEST(TouchFrequency, IsZeroWithoutPosesAndChecksItsArguments) {
  const ReportBodies bodies = protease();
  EXPECT_EQ(touch_frequency(report_run(bodies, 0), bodies, 5.0, 10).maxCoeff(), 0.0);
  EXPECT_THROW((void)touch_frequency(report_run(bodies, 1), bodies, 0.0, 10), InputError);
  EXPECT_THROW((void)touch_frequency(report_run(bodies, 1), bodies, 5.0, 0), InputError);
}

}  // namespace
}  // namespace mortise::testing
