// SPDX-License-Identifier: GPL-3.0-or-later
// Clusters of a report: by which measure, of which size, and as tables.
#include "mortise/report/clusters.hpp"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "mortise/core/errors.hpp"
#include "mortise/poses/cluster.hpp"
#include "sample_report.hpp"

namespace mortise::testing {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::vector<int> numbers(const mortise::Run& run) {
  std::vector<int> list;
  for (const Pose& pose : run.poses.poses) list.push_back(pose.cluster);
  return list;
}

// Three poses near each other, one far away, one near the first again.
mortise::Run five_poses(const ReportBodies& bodies) {
  mortise::Run run = report_run(bodies, 5);
  const double x[] = {0.0, 1.0, 2.0, 40.0, 0.5};
  for (std::size_t i = 0; i < 5; ++i) {
    run.poses.poses[i].moving_in_fixed = {Eigen::Quaterniond::Identity(), {x[i], 0.0, 0.0}};
    run.poses.poses[i].cluster = -1;
  }
  return run;
}

TEST(ReportClusters, BelowTheLeastSizeAreDissolvedAndThePosesStay) {
  const ReportBodies bodies = protease();
  mortise::Run run = five_poses(bodies);
  const ReportClusters all = cluster_run(run, bodies, {.radius = 1.2});
  EXPECT_THAT(numbers(run), ElementsAre(0, 0, 1, 2, 0));
  EXPECT_THAT(all.representatives, ElementsAre(0, 2, 3));
  EXPECT_THAT(all.sizes, ElementsAre(3, 1, 1));
  EXPECT_EQ(all.measure, "ligand");
  const ReportClusters large = cluster_run(run, bodies, {.radius = 1.2, .min_size = 2});
  EXPECT_THAT(numbers(run), ElementsAre(0, 0, -1, -1, 0));
  EXPECT_THAT(large.representatives, ElementsAre(0));
  EXPECT_EQ(run.poses.poses.size(), 5u);
  EXPECT_TRUE(std::isnan(run.metrics[0].values[2]));
  EXPECT_EQ(run.metrics[0].values[4], 3.0);
}

TEST(ReportClusters, OfTheRunAreNumberedAnewWithoutTheSmallOnes) {
  const ReportBodies bodies = protease();
  mortise::Run run = five_poses(bodies);
  const int own[] = {3, 1, 1, 3, 0};
  for (std::size_t i = 0; i < 5; ++i) run.poses.poses[i].cluster = own[i];
  const ReportClusters clusters = cluster_run(run, bodies, {.min_size = 2});
  EXPECT_EQ(clusters.measure, "run");
  EXPECT_THAT(numbers(run), ElementsAre(0, 1, 1, 0, -1));
  EXPECT_THAT(clusters.representatives, ElementsAre(0, 1));
}

TEST(ReportClusters, ByInterfaceAreThoseOfTheLibraryOverTheBackbone) {
  const ReportBodies bodies = protease();
  mortise::Run run = report_run(bodies, 300);
  const ReportClusters clusters =
      cluster_run(run, bodies, {.measure = ClusterMeasure::kInterface, .radius = 4.0});
  EXPECT_EQ(clusters.measure, "interface");
  EXPECT_EQ(clusters.interface_cutoff, 10.0);
  // The reference: the four backbone atoms, picked here.
  const auto backbone = [](const Molecule& molecule) {
    Eigen::Matrix3Xd points(3, 0);
    for (const Atom& atom : molecule.atoms)
      if (!atom.hetero &&
          std::string(" N CA C O ").find(" " + atom.name + " ") != std::string::npos) {
        points.conservativeResize(3, points.cols() + 1);
        points.rightCols<1>() = atom.position;
      }
    return points;
  };
  std::vector<RigidMotion> motions;
  for (const Pose& pose : run.poses.poses) motions.push_back(pose.moving_in_fixed);
  const Clusters expected = cluster_poses_by_interface(
      motions, backbone(bodies.fixed.molecule), backbone(bodies.moving.molecule), {.radius = 4.0});
  EXPECT_EQ(numbers(run), expected.cluster_of);
  EXPECT_EQ(clusters.representatives, expected.founders);
  EXPECT_EQ(clusters.sizes, expected.sizes);
  EXPECT_LT(clusters.sizes.size(), 300u);
}

TEST(ReportClusters, OfPartsByInterface) {
  const ReportBodies bodies = plate_and_pin();
  mortise::Run run = report_run(bodies, 3);
  // Superposed, both bodies share a shift: 0.1 apart makes at most 0.05.
  for (std::size_t i = 0; i < 3; ++i)
    run.poses.poses[i].moving_in_fixed.translation = {0.0, 0.0,
                                                      i == 2 ? 1.0 : 0.1 * static_cast<double>(i)};
  for (Pose& pose : run.poses.poses) pose.moving_in_fixed.rotation.setIdentity();
  const ReportClusters clusters =
      cluster_run(run, bodies, {.measure = ClusterMeasure::kInterface, .radius = 0.08});
  EXPECT_THAT(numbers(run), ElementsAre(0, 0, 1));
  EXPECT_GT(clusters.interface_cutoff, 0.0);
}

TEST(ReportClusters, AsTablesNameTheRepresentativeAndTheRule) {
  const ReportBodies bodies = protease();
  mortise::Run run = five_poses(bodies);
  const ReportClusters clusters = cluster_run(run, bodies, {.radius = 1.2, .min_size = 2});
  const std::string csv = clusters_csv(run, clusters);
  EXPECT_THAT(csv, HasSubstr("cluster,representative,size,score,shape,contact,interface_rmsd"));
  EXPECT_THAT(csv, HasSubstr("\n0,1,3,"));
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 2);
  const nlohmann::json json = nlohmann::json::parse(clusters_json(run, clusters));
  EXPECT_EQ(json["measure"], "ligand");
  EXPECT_EQ(json["radius"], 1.2);
  EXPECT_EQ(json["min_size"], 2);
  ASSERT_EQ(json["clusters"].size(), 1u);
  EXPECT_EQ(json["clusters"][0]["representative"], 1);
  EXPECT_EQ(json["clusters"][0]["size"], 3);
  EXPECT_EQ(json["clusters"][0]["score"], run.poses.poses[0].score);
  EXPECT_EQ(json["clusters"][0]["metrics"]["dockq"],
            run.metrics.back().name == "capri" ? run.metrics[4].values[0] : 0.0);
  mortise::Run none = report_run(bodies, 0);
  EXPECT_THAT(cluster_run(none, bodies).sizes, IsEmpty());
}

TEST(ReportClusters, RefuseWhatMakesNoSense) {
  const ReportBodies bodies = protease();
  mortise::Run run = five_poses(bodies);
  const auto refuses = [&](const ReportBodies& with, const ReportClusterOptions& options) {
    EXPECT_THROW((void)cluster_run(run, with, options), InputError);
  };
  refuses(bodies, {.radius = -1.0});
  refuses(bodies, {.radius = std::nan("")});
  refuses(bodies, {.radius = std::numeric_limits<double>::infinity()});
  refuses(bodies, {.min_size = 0});
  refuses(bodies, {.measure = ClusterMeasure::kInterface, .radius = 0.0});
  refuses({}, {.measure = ClusterMeasure::kInterface, .radius = 2.0});
  refuses({}, {.radius = 2.0});
  EXPECT_THROW((void)parse_cluster_measure("fnat"), InputError);
  EXPECT_EQ(parse_cluster_measure("interface"), ClusterMeasure::kInterface);
}

}  // namespace
}  // namespace mortise::testing
