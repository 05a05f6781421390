// SPDX-License-Identifier: GPL-3.0-or-later
// mortise evaluate on poses whose worth is known beforehand.
#include <algorithm>
#include <cmath>
#include <fstream>

#include "apps/program.hpp"
#include "mortise/store/provenance.hpp"

namespace mortise {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using testing::Outcome;

constexpr const char* kReferences =
    " --reference-fixed 1hpv_complex.pdb:A --reference-moving 1hpv_complex.pdb:B";

class Evaluate : public testing::Program {
 protected:
  // Three poses: 40 A off, 7 A off, right. The sample's ligand sits right at the identity.
  Evaluate() {
    run_.provenance = make_provenance("test");
    run_.provenance.working_directory = scratch_.path().string();
    run_.fixed.path = run_.fixed.spec = "1hpv_receptor.pdb";
    run_.moving.path = run_.moving.spec = "1hpv_ligand.pdb";
    run_.fixed.sha256 = sha256_of_file(path("1hpv_receptor.pdb"));
    run_.moving.sha256 = sha256_of_file(path("1hpv_ligand.pdb"));
    run_.complete = true;
    for (const double shift : {40.0, 7.0, 0.0}) {
      Pose pose;
      pose.moving_in_fixed.translation = {shift, 0.0, 0.0};
      pose.score = shift;
      run_.poses.poses.push_back(pose);
    }
    write_run(path("run.h5"), run_);
  }
  mortise::Run run_;
};

TEST_F(Evaluate, AddsMetricsAndFindsTheFirstGoodPoses) {
  const nlohmann::json json = this->json(std::string("evaluate run.h5") + kReferences);
  const mortise::Run run = read_run(path("run.h5"));
  ASSERT_EQ(run.metrics.size(), 5U);
  EXPECT_EQ(run.metrics[0].name, "interface_rmsd");
  EXPECT_EQ(run.metrics[1].name, "ligand_rmsd");
  EXPECT_EQ(run.metrics[2].name, "fnat");
  EXPECT_EQ(run.metrics[3].name, "dockq");
  EXPECT_EQ(run.metrics[4].name, "capri");
  // A pure shift: L-RMSD is its length. The file's three decimals leave no error, as both are it.
  EXPECT_NEAR(run.metrics[1].values[0], 40.0, 1e-6);
  EXPECT_NEAR(run.metrics[1].values[1], 7.0, 1e-6);
  for (const std::size_t m : {0U, 1U}) EXPECT_NEAR(run.metrics[m].values[2], 0.0, 1e-5);
  EXPECT_EQ(run.metrics[2].values[0], 0.0);
  EXPECT_EQ(run.metrics[2].values[2], 1.0);
  EXPECT_NEAR(run.metrics[3].values[2], 1.0, 1e-9);
  EXPECT_EQ(run.metrics[4].values[0], 0.0);
  EXPECT_EQ(run.metrics[4].values[2], 3.0);
  EXPECT_EQ(json["first_high"], 3);
  EXPECT_EQ(json["first_medium"], 3);
  EXPECT_EQ(json["first_irmsd_2_5"], 3);
  EXPECT_EQ(json["first_acceptable_by_rmsd"], 2);
  EXPECT_EQ(json["first_acceptable"], run.metrics[4].values[1] >= 1.0 ? 2 : 3);
  EXPECT_TRUE(json["first_within_2_percent"].is_null());
  EXPECT_NEAR(json["best_interface_rmsd"].get<double>(), 0.0, 1e-5);
  EXPECT_NEAR(json["best_ligand_rmsd"].get<double>(), 0.0, 1e-5);
  EXPECT_EQ(json["best_fnat"], 1.0);
  EXPECT_NEAR(json["best_dockq"].get<double>(), 1.0, 1e-9);
  EXPECT_EQ(json["superposed"]["capri"], "high");
}

TEST_F(Evaluate, FirstRanksAreNullWhereThereIsNone) {
  run_.poses.poses.resize(1);
  write_run(path("run.h5"), run_);
  const nlohmann::json json = this->json(std::string("evaluate run.h5") + kReferences);
  for (const char* key : {"first_acceptable", "first_medium", "first_high", "first_irmsd_2_5",
                          "first_acceptable_by_rmsd"})
    EXPECT_TRUE(json[key].is_null()) << key;
  EXPECT_NEAR(json["best_ligand_rmsd"].get<double>(), 40.0, 1e-6);
}

TEST_F(Evaluate, PrintsATableAndMayRunAgain) {
  const Outcome first = must(std::string("evaluate run.h5") + kReferences);
  EXPECT_THAT(first.out, AllOf(HasSubstr("receptor     99 of the reference's 99 residues"),
                               HasSubstr("high                         3\n"),
                               HasSubstr("superposed   i-RMSD 0.00"), HasSubstr("incorrect\n")));
  const std::string bytes = read_whole_file(path("run.h5"));
  EXPECT_EQ(must(std::string("evaluate run.h5 --threads 1") + kReferences).out, first.out);
  EXPECT_EQ(read_whole_file(path("run.h5")), bytes);
}

TEST_F(Evaluate, DescribesTheInterfacesOfTheBestPoses) {
  std::reverse(run_.poses.poses.begin(), run_.poses.poses.end());
  write_run(path("run.h5"), run_);
  must(std::string("evaluate run.h5 --interface 2") + kReferences);
  const mortise::Run run = read_run(path("run.h5"));
  ASSERT_EQ(run.metrics.size(), 11U);
  EXPECT_EQ(run.metrics[6].name, "buried_area");
  EXPECT_GT(run.metrics[6].values[0], 500.0);
  EXPECT_EQ(run.metrics[10].name, "sc");
  EXPECT_GT(run.metrics[10].values[0], 0.5);
  for (std::size_t m = 5; m < 11; ++m) EXPECT_TRUE(std::isnan(run.metrics[m].values[2]));
}

TEST_F(Evaluate, NamesEachFaultInOneLine) {
  expect_user_error("evaluate run.h5", "--reference-fixed");
  expect_user_error(std::string("evaluate none.h5") + kReferences,
                    "none.h5: expected a file, found none");
  expect_user_error(
      "evaluate run.h5 --reference-fixed none.pdb --reference-moving 1hpv_complex.pdb:B",
      "none.pdb");
  expect_user_error(
      "evaluate run.h5 --reference-fixed 1hpv_complex.pdb:A --reference-moving 1hpv_complex.pdb:C",
      "C");
  std::ofstream(path("1hpv_ligand.pdb"), std::ios::app) << "REMARK changed\n";
  expect_user_error(std::string("evaluate run.h5") + kReferences,
                    "the run's moving input has changed");
  must(std::string("evaluate run.h5 --force") + kReferences);
  run_.poses.poses.clear();
  write_run(path("run.h5"), run_);
  expect_user_error(std::string("evaluate run.h5") + kReferences, "holds no poses");
}

}  // namespace
}  // namespace mortise
