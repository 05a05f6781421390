// SPDX-License-Identifier: GPL-3.0-or-later
// All files of a report, and the program that writes them.
#include "mortise/report/write_report.hpp"

#include <gmock/gmock.h>

#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "apps/program.hpp"
#include "mortise/core/errors.hpp"
#include "mortise/parts/format_part.hpp"
#include "mortise/report/page.hpp"
#include "mortise/report/viewer_scripts.hpp"
#include "sample_report.hpp"

namespace mortise::testing {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

TEST(WriteReport, WritesWhatItListsAndPosesWhereTheyBelong) {
  const tests::ScratchDirectory scratch;
  const ReportBodies bodies = protease();
  const mortise::Run run = report_run(bodies, 20);
  const ReportFiles result = write_report(run, bodies, scratch / "a/b", {.structures = 2});
  for (const std::string& name : result.files)
    EXPECT_TRUE(std::filesystem::exists(scratch / ("a/b/" + name))) << name;
  for (const char* name :
       {"poses.csv", "poses.json", "clusters.csv", "clusters.json", "poses/fixed.pdb",
        "poses/pose_0001.pdb", "poses/pose_0002.pdb", "poses.pml", "poses.cxc"})
    EXPECT_THAT(result.files, Contains(name));
  EXPECT_EQ(report_page_available(), result.files.front() == "index.html");
  EXPECT_EQ(report_page_available(), result.warnings.empty());

  const Molecule second = read_molecule({scratch / "a/b/poses/pose_0002.pdb"}).molecule;
  ASSERT_EQ(second.atoms.size(), bodies.moving.molecule.atoms.size());
  for (std::size_t i = 0; i < second.atoms.size(); ++i)
    EXPECT_LT((second.atoms[i].position -
               run.poses.poses[1].moving_in_fixed * bodies.moving.molecule.atoms[i].position)
                  .norm(),
              1e-3);  // a PDB file has three decimals
  const std::string csv = read_whole_file(scratch / "a/b/poses.csv");
  EXPECT_THAT(csv.substr(0, csv.find('\n')), HasSubstr("cluster_size"));
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 21);
  EXPECT_EQ(nlohmann::json::parse(read_whole_file(scratch / "a/b/poses.json"))["poses"].size(),
            20u);
}

TEST(WriteReport, WritesMmcifWherePdbHasNoRoomAndTablesWithoutPoses) {
  const tests::ScratchDirectory scratch;
  ReportBodies bodies = protease();
  for (Atom& atom : bodies.moving.molecule.atoms) atom.chain = "LONG";
  const ReportFiles cif = write_report(report_run(bodies, 3), bodies, scratch / "cif");
  EXPECT_THAT(cif.files, Contains("poses/pose_0003.cif"));
  EXPECT_EQ(read_molecule({scratch / "cif/poses/pose_0003.cif"}).molecule.atoms[0].chain, "LONG");
  const ReportFiles none = write_report(report_run(bodies, 0), bodies, scratch / "none");
  EXPECT_THAT(none.files, Not(Contains("poses.pml")));
  EXPECT_EQ(nlohmann::json::parse(read_whole_file(scratch / "none/poses.json"))["poses"].size(),
            0u);
}

TEST(WriteReport, WritesPartsAsStlWhereTheyBelong) {
  const tests::ScratchDirectory scratch;
  const ReportBodies bodies = plate_and_pin();
  const mortise::Run run = report_run(bodies, 4);
  const ReportFiles result = write_report(run, bodies, scratch / "parts", {.structures = 2});
  EXPECT_THAT(result.files, Contains("poses/pose_0002.stl"));
  EXPECT_EQ(read_whole_file(scratch / "parts/poses/pose_0002.stl"),
            format_stl(bodies.moving.mesh, run.poses.poses[1].moving_in_fixed));
  EXPECT_EQ(read_whole_file(scratch / "parts/poses/fixed.stl"), format_stl(bodies.fixed.mesh));
  EXPECT_THAT(read_whole_file(scratch / "parts/poses.pml"), Not(HasSubstr("cartoon")));
}

TEST(WriteReport, GoesOnWithoutStructures) {
  const tests::ScratchDirectory scratch;
  ReportBodies bodies = protease();
  const mortise::Run run = report_run(bodies, 4);
  bodies.moving = {};
  const ReportFiles result = write_report(run, bodies, scratch / "bare");
  EXPECT_THAT(result.files, Contains("clusters.csv"));
  EXPECT_THAT(result.files, Not(Contains("poses.pml")));
  EXPECT_THAT(result.warnings, Contains(HasSubstr("no structure files")));
}

TEST(WriteReport, RefusesADirectoryThatCannotBe) {
  const tests::ScratchDirectory scratch;
  write_file_atomically(scratch / "file", "here");
  const ReportBodies bodies = protease();
  EXPECT_THROW((void)write_report(report_run(bodies, 1), bodies, scratch / "file/report"),
               FileError);
}

TEST(ViewerScripts, LoadEachFileOnceAndShowTheBestPose) {
  const ViewerFiles files = {"poses/fixed.pdb", {"poses/pose_0001.pdb", "poses/pose_0002.pdb"}};
  const std::string pymol = pymol_script(files);
  EXPECT_THAT(pymol, HasSubstr("load poses/pose_0002.pdb, pose_0002\n"));
  EXPECT_THAT(pymol, HasSubstr("disable pose_0002\n"));
  EXPECT_THAT(pymol, Not(HasSubstr("disable pose_0001\n")));
  const std::string chimerax = chimerax_script(files);
  EXPECT_THAT(chimerax, HasSubstr("open poses/fixed.pdb\nopen poses/pose_0001.pdb\n"));
  EXPECT_THAT(chimerax, HasSubstr("hide #3-3 models\n"));
  ViewerFiles alone = {"fixed.stl", {}, true};
  EXPECT_THAT(pymol_script(alone), Not(HasSubstr("cartoon")));
  EXPECT_THAT(chimerax_script(alone), Not(HasSubstr("#2")));
}

// What Debian's pymol says of a report's script and of what is shown after it.
std::string in_pymol(const std::string& directory) {
  write_file_atomically(directory + "/check.pml",
                        "print('shown', cmd.get_names('objects', enabled_only=1))\n"
                        "print('all', len(cmd.get_names('objects')), cmd.count_atoms('interface') "
                        "if 'interface' in cmd.get_names('all') else 0)\n");
  const std::string command = "cd '" + directory +
                              "' && PATH=/usr/bin:/bin HOME=. timeout 300 pymol -cq poses.pml "
                              "check.pml > pymol.log 2>&1 < /dev/null";
  EXPECT_EQ(std::system(command.c_str()), 0);  // NOLINT(cert-env33-c): a test's own words
  return read_whole_file(directory + "/pymol.log");
}

TEST(ViewerScripts, RunInPymol) {
  if (!std::filesystem::exists("/usr/bin/pymol")) GTEST_SKIP() << "there is no /usr/bin/pymol";
  const tests::ScratchDirectory scratch;
  const ReportBodies molecules = protease();
  mortise::Run run = report_run(molecules, 3);
  for (Pose& pose : run.poses.poses) pose.moving_in_fixed = {};
  (void)write_report(run, molecules, scratch / "molecules", {.structures = 2, .interfaces = 0});
  const std::string docked = in_pymol(scratch / "molecules");
  EXPECT_THAT(docked, HasSubstr("shown ['fixed_body', 'pose_0001']"));
  EXPECT_THAT(docked, Not(HasSubstr("Error")));
  EXPECT_THAT(docked, Not(HasSubstr("all 3 0\n"))) << "the interface has atoms";
  const ReportBodies parts = plate_and_pin();
  (void)write_report(report_run(parts, 3), parts, scratch / "parts", {.structures = 2});
  const std::string mated = in_pymol(scratch / "parts");
  EXPECT_THAT(mated, HasSubstr("shown ['fixed_body', 'pose_0001']"));
  EXPECT_THAT(mated, HasSubstr("all 3 0\n"));
  EXPECT_THAT(mated, Not(HasSubstr("Error")));
}

class ReportCommand : public Program {};

TEST_F(ReportCommand, ReportsADockingRun) {
  must("dock 1hpv_receptor.pdb 1hpv_ligand.pdb -o run.h5 --rotations 60 --poses 20 --quiet");
  const Outcome outcome = must("report run.h5 -o out --top 2");
  EXPECT_THAT(outcome.out, HasSubstr("files to out"));
  EXPECT_TRUE(std::filesystem::exists(path("out/poses/pose_0002.pdb")));
  const nlohmann::json json = this->json("report run.h5");
  EXPECT_EQ(json["directory"], "run_report");
  EXPECT_EQ(json["poses"], 20);

  std::filesystem::create_directory(path("moved"));
  std::filesystem::rename(path("run.h5"), path("moved/run.h5"));
  std::filesystem::rename(path("1hpv_ligand.pdb"), path("moved/other.pdb"));
  EXPECT_THAT(must("report moved/run.h5").error,
              HasSubstr("was found by its SHA-256 at moved/other.pdb"));
  must("report moved/run.h5 --cluster interface --cluster-radius 4 --min-cluster-size 2");
  EXPECT_EQ(
      nlohmann::json::parse(read_whole_file(path("moved/run_report/clusters.json")))["measure"],
      "interface");
  expect_user_error("report moved/run.h5 --min-cluster-size 0", "must be >= 1, got 0");
  expect_user_error("report moved/run.h5 --cluster-radius -2", "must be >= 0, got -2");
  std::filesystem::create_directories(path("archive/deep"));
  std::filesystem::rename(path("moved/other.pdb"), path("archive/deep/other.pdb"));
  EXPECT_THAT(must("report moved/run.h5 --search archive").error,
              HasSubstr("was found by its SHA-256 at archive/deep/other.pdb"));
  std::filesystem::remove(path("archive/deep/other.pdb"));
  EXPECT_THAT(must("report moved/run.h5 --allow-missing").error, HasSubstr("Without structures: "));
  expect_user_error("report moved/run.h5", "1hpv_ligand.pdb: the run's moving input is not there");
  expect_user_error("report 1hpv_receptor.pdb", "1hpv_receptor.pdb");
}

}  // namespace
}  // namespace mortise::testing
