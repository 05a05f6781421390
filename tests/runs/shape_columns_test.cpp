// SPDX-License-Identifier: GPL-3.0-or-later
// Columns of a run on what its shape scores leave out: against the exact pair sum, pose by pose.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "mortise/affinity/double_skin.hpp"
#include "mortise/runs/dock.hpp"
#include "mortise/scoring/contact_potential.hpp"
#include "mortise/scoring/shape_scores.hpp"

namespace mortise {
namespace {

std::map<std::string, std::vector<double>> columns_of(const mortise::Run& run) {
  std::map<std::string, std::vector<double>> columns;
  for (const MetricColumn& column : run.metrics) columns[column.name] = column.values;
  return columns;
}

TEST(ShapeColumns, BoundTheErrorOfEachScoreAndGiveItsSlope) {
  DockOptions options;
  options.rotations = 120;
  options.poses = 60;
  options.described = 40;
  options.random_start = 2;
  const mortise::Run run =
      dock(read_body(MORTISE_SOURCE_DIR "/molecules/1hpv_receptor.pdb"),
           read_body(MORTISE_SOURCE_DIR "/molecules/1hpv_ligand.pdb"), options);
  const double unit = fitted_contact_potential().shape;
  const Channel channel = double_skin_channel(run.fixed.knots, run.moving.knots);
  std::vector<RigidMotion> found, ends;
  const CandidateFrames frames{run.rotations.quaternions, run.fixed.search_from_input,
                               run.moving.search_from_input};
  for (const Pose& pose : run.poses.poses) {
    found.push_back(candidate_motion(run.candidates.at(pose.candidate), frames));
    ends.push_back(pose.moving_in_fixed);
  }
  const Eigen::MatrixXd exact = exact_scores(channel, found);
  const Eigen::MatrixXd near =
      low_passed_scores(channel, ends, {.low_pass = {.cutoff = 0.25}, .offsets = {-0.05, 0.05}});
  auto columns = columns_of(run);
  double slopes = 0.0, misses = 0.0;
  for (std::size_t i = 0; i < run.poses.poses.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    const double low_pass = columns["shape_low_pass"].at(i);
    const double spread = columns["shape_spread"].at(i);
    if (i >= 40) {
      EXPECT_TRUE(std::isnan(low_pass) && std::isnan(spread));
      continue;
    }
    const double error = std::abs(run.poses.poses[i].channels[0] - unit * exact(0, at));
    EXPECT_LE(error, 1.001 * (low_pass + spread) + 1e-6) << i;
    EXPECT_GT(spread, 0.0);
    const double slope = unit * (near(1, at) - near(0, at)) / 0.1;
    slopes += slope * slope;
    misses += std::pow(columns["shape_offset_slope"].at(i) - slope, 2);
  }
  EXPECT_LT(std::sqrt(misses / slopes), 0.05);  // maps of 1.5 A against 1 A, steps of 0.08 and 0.05
}

}  // namespace
}  // namespace mortise
