// SPDX-License-Identifier: GPL-3.0-or-later
// The run as the report shows it: clusters, and the candidates of an unfinished search.
#include <gmock/gmock.h>

#include "mortise/core/errors.hpp"
#include "mortise/report/write_report.hpp"
#include "sample_report.hpp"

namespace mortise::testing {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;

std::vector<double> sizes_of(const Run& run) {
  for (const MetricColumn& metric : run.metrics)
    if (metric.name == "cluster_size") return metric.values;
  return {};
}

// Three poses near each other, one far away, one near the first again.
Run five_clusters(const ReportBodies& bodies) {
  mortise::Run run = report_run(bodies, 5);
  const double x[] = {0.0, 1.0, 2.0, 40.0, 0.5};
  for (std::size_t i = 0; i < 5; ++i) {
    run.poses.poses[i].moving_in_fixed = {Eigen::Quaterniond::Identity(), {x[i], 0.0, 0.0}};
    run.poses.poses[i].cluster = static_cast<int>(i);
  }
  return run;
}

TEST(PrepareReport, ClustersByTheRadiusAndCountsThem) {
  const ReportBodies bodies = protease();
  const mortise::Run shown =
      prepare_report(five_clusters(bodies), bodies, {.clusters = {.radius = 1.2}}).run;
  EXPECT_THAT(sizes_of(shown), ElementsAre(3, 3, 1, 1, 3));
  EXPECT_EQ(shown.poses.poses[4].cluster, 0);
  EXPECT_EQ(shown.poses.poses[3].cluster, 2);
}

TEST(PrepareReport, KeepsTheRunsOwnClustersWhereItHasSome) {
  const ReportBodies bodies = protease();
  mortise::Run run = five_clusters(bodies);
  EXPECT_THAT(sizes_of(prepare_report(run, bodies, {.clusters = {.radius = 0.0}}).run), Each(1.0));
  // All alone: clustered anew with a tenth of the diameter, about 5 angstrom.
  EXPECT_THAT(sizes_of(prepare_report(run, bodies).run), ElementsAre(4, 4, 4, 1, 4));
  run.poses.poses[3].cluster = 0;
  EXPECT_THAT(sizes_of(prepare_report(run, bodies).run), ElementsAre(2, 1, 1, 2, 1));
}

TEST(PrepareReport, ReplacesAnEarlierCount) {
  const ReportBodies bodies = protease();
  const mortise::Run once = prepare_report(five_clusters(bodies), bodies).run;
  const mortise::Run twice = prepare_report(once, bodies).run;
  EXPECT_EQ(twice.metrics.size(), once.metrics.size());
}

TEST(PrepareReport, ShowsTheCandidatesOfAnUnfinishedSearchInInputFrames) {
  const ReportBodies bodies = protease();
  mortise::Run run = report_run(bodies, 0);
  run.complete = false;
  run.candidates = sample_candidates(60);
  const mortise::Run shown = prepare_report(run, bodies).run;
  ASSERT_EQ(shown.poses.poses.size(), 60u);
  const std::vector<Candidate>& c = run.candidates;
  for (std::size_t i = 0; i < 60; ++i) {  // its scores fall already
    const Pose& pose = shown.poses.poses[i];
    EXPECT_EQ(pose.score, c[i].score);
    // A point, by the search's frames step by step.
    const Eigen::Vector3d point(3.0, -7.0, 11.0);
    const Eigen::Vector4d q = run.rotations.quaternions.col(c[i].rotation_index);
    const Eigen::Vector3d searched =
        Eigen::Quaterniond(q[0], q[1], q[2], q[3]) * (run.moving.search_from_input * point) +
        Eigen::Vector3d(c[i].translation[0], c[i].translation[1], c[i].translation[2]);
    EXPECT_LT((run.fixed.search_from_input * (pose.moving_in_fixed * point) - searched).norm(),
              1e-9);
    EXPECT_GE(pose.moving_in_fixed.rotation.w(), 0.0);
  }
}

TEST(PrepareReport, DescribesTheBestInterfacesOnce) {
  const ReportBodies bodies = protease();
  const auto column = [](const mortise::Run& run, const std::string& name) {
    for (const MetricColumn& metric : run.metrics)
      if (metric.name == name) return metric.values;
    return std::vector<double>();
  };
  mortise::Run run = report_run(bodies, 6);
  EXPECT_THAT(column(prepare_report(run, bodies, {.interfaces = 0}).run, "buried_area"),
              ::testing::IsEmpty());
  const mortise::Run shown = prepare_report(run, bodies, {.interfaces = 2}).run;
  const std::vector<double> areas = column(shown, "buried_area");
  ASSERT_EQ(areas.size(), 6u);
  EXPECT_GT(areas[0], 1000.0);  // the complex itself, square angstrom
  EXPECT_TRUE(std::isnan(areas[2]));
  const mortise::Run again = prepare_report(shown, bodies, {.interfaces = 6}).run;
  EXPECT_TRUE(std::isnan(column(again, "buried_area")[2])) << "kept as the run has them";
}

TEST(PrepareReport, RefusesOptionsOutOfRange) {
  const ReportBodies bodies = protease();
  const mortise::Run run = report_run(bodies, 2);
  EXPECT_THROW((void)prepare_report(run, bodies, {.structures = -1}), InputError);
  EXPECT_THROW((void)prepare_report(run, bodies, {.clusters = {.radius = -0.1}}), InputError);
  EXPECT_THROW((void)prepare_report(run, bodies, {.clusters = {.radius = std::nan("")}}),
               InputError);
  EXPECT_THROW((void)prepare_report(run, bodies, {.pictures = -1}), InputError);
  EXPECT_THROW((void)prepare_report(run, bodies, {.interfaces = -1}), InputError);
}

}  // namespace
}  // namespace mortise::testing
