// SPDX-License-Identifier: GPL-3.0-or-later
// mortise export and mortise info as a user runs them: output, files, exit codes, one-line errors.
#include "helpers/program.hpp"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "mortise/molecules/read_molecule.hpp"
#include "mortise/store/atomic_file.hpp"
#include "mortise/store/knots_file.hpp"
#include "sample_run.hpp"

namespace mortise {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;
using tests::Outcome;

class Program : public tests::ProgramTest {
 protected:
  Program() {
    const std::string molecules = std::string(MORTISE_SOURCE_DIR) + "/molecules/";
    fs::copy_file(molecules + "1hpv_receptor.pdb", scratch_ / "receptor.pdb");
    fs::copy_file(molecules + "1hpv_ligand.pdb", scratch_ / "ligand.pdb");
    run_ = testing::sample_run(12);
    run_.provenance.working_directory = scratch_.path().string();
    run_.fixed.path = run_.fixed.spec = "receptor.pdb";
    run_.moving.path = run_.moving.spec = "ligand.pdb";
    run_.fixed.sha256 = sha256_of_file(scratch_ / "receptor.pdb");
    run_.moving.sha256 = sha256_of_file(scratch_ / "ligand.pdb");
    write_run(scratch_ / "run.h5", run_);
  }

  mortise::Run run_;
};

TEST_F(Program, ExportWritesEachFormatBesideTheRun) {
  for (const auto& [format, file] :
       {std::pair{"pdb", "run_poses.pdb"}, std::pair{"cif", "run_poses.cif"},
        std::pair{"csv", "run_poses.csv"}, std::pair{"json", "run_poses.json"},
        std::pair{"zdock", "run_poses.out"}}) {
    const Outcome outcome = mortise(std::string("export run.h5 --top 3 --format ") + format);
    EXPECT_EQ(outcome.code, 0) << outcome.error;
    EXPECT_EQ(outcome.out, std::string("wrote 3 poses to ") + file + "\n");
    EXPECT_GT(fs::file_size(scratch_ / file), 200U);
  }
  const Molecule third =
      read_molecule({scratch_ / "run_poses.pdb", 3, {}}, {.keep_hydrogens = true}).molecule;
  const Molecule ligand =
      read_molecule({scratch_ / "ligand.pdb", 0, {}}, {.keep_hydrogens = true}).molecule;
  ASSERT_EQ(third.atoms.size(), ligand.atoms.size());
  EXPECT_LT(
      (third.atoms[5].position - run_.poses.poses[2].moving_in_fixed * ligand.atoms[5].position)
          .norm(),
      0.001);
}

TEST_F(Program, ExportGoesToStdoutOrANamedFile) {
  const Outcome csv = mortise("export run.h5 --format csv -o -");
  EXPECT_EQ(csv.code, 0);
  EXPECT_EQ(std::count(csv.out.begin(), csv.out.end(), '\n'), 13);
  EXPECT_THAT(csv.out, StartsWith("rank,score,"));
  const Outcome json = mortise("export run.h5 --format pdb --pose 7 --complex -o seven.pdb --json");
  EXPECT_EQ(json.code, 0) << json.error;
  EXPECT_EQ(nlohmann::json::parse(json.out),
            (nlohmann::json{{"file", "seven.pdb"}, {"format", "pdb"}, {"poses", 1}}));
  EXPECT_THAT(read_whole_file(scratch_ / "seven.pdb"), HasSubstr("\nMODEL        7"));
  EXPECT_EQ(mortise("export run.h5 --format csv --quiet").out, "");
}

TEST_F(Program, ExportNamesInputsThatMovedOrChanged) {
  fs::rename(scratch_ / "ligand.pdb", scratch_ / "elsewhere.pdb");
  expect_user_error("export run.h5 --format pdb",
                    "ligand.pdb: the run's moving input is not there");
  EXPECT_EQ(mortise("export run.h5 --format pdb --moving elsewhere.pdb").code, 0);
  EXPECT_EQ(mortise("export run.h5 --format zdock --moving elsewhere.pdb").code, 0);
  EXPECT_THAT(read_whole_file(scratch_ / "run_poses.out"), HasSubstr("\nelsewhere.pdb\t"));
  EXPECT_EQ(mortise("export run.h5 --format csv").code, 0);  // tables need no inputs
  std::ofstream(scratch_ / "elsewhere.pdb", std::ios::app) << "REMARK changed\n";
  expect_user_error("export run.h5 --format pdb --moving elsewhere.pdb",
                    "elsewhere.pdb: the run's moving input has changed: expected SHA-256");
  EXPECT_EQ(mortise("export run.h5 --format pdb --moving elsewhere.pdb --force").code, 0);
  std::ofstream(scratch_ / "receptor.pdb", std::ios::app) << "REMARK changed\n";
  expect_user_error("export run.h5 --format pdb --complex --moving elsewhere.pdb", "fixed input");
}

TEST_F(Program, ExportKeepsTheRecordedChainsWhenAFileMoved) {
  const std::string text = read_whole_file(scratch_ / "ligand.pdb");
  const Molecule ligand = read_molecule({scratch_ / "ligand.pdb", 0, {}}).molecule;
  run_.moving.spec = "ligand.pdb:" + ligand.atoms.front().chain;
  write_run(scratch_ / "chain.h5", run_);
  fs::rename(scratch_ / "ligand.pdb", scratch_ / "elsewhere.pdb");
  EXPECT_EQ(mortise("export chain.h5 --format pdb --moving elsewhere.pdb").code, 0);
  run_.moving.spec = "ligand.pdb:9";
  write_run(scratch_ / "chain.h5", run_);
  expect_user_error("export chain.h5 --format pdb --moving elsewhere.pdb", "9");
}

TEST_F(Program, ExportRefusesWhatMakesNoSense) {
  expect_user_error("export run.h5 --format xyz",
                    "expected pdb, cif, csv, json, zdock, stl, ply or step");
  expect_user_error("export run.h5 --format pdb --pose 13", "the run holds 12 poses");
  expect_user_error("export run.h5 --format csv -o - --json", "choose one");
  expect_user_error("export run.h5 --format csv -o no/such/dir.csv", "there is no directory");
  expect_user_error("export run.h5 --format pdb -o ligand.pdb", "found an input");
  expect_user_error("export run.h5 --format csv -o run.h5", "found an input");
  expect_user_error("export ligand.pdb --format csv", "expected an HDF5 file");
  expect_user_error("export none.h5 --format csv", "none.h5: expected a file, found none");
  run_.kind = "mate";
  run_.moving.kind = "part";
  write_run(scratch_ / "mate.h5", run_);
  expect_user_error("export mate.h5 --format pdb", "of this mate run is a part");
}

TEST_F(Program, InfoShowsRunsKnotsAndStructures) {
  const Outcome run = mortise("info run.h5");
  EXPECT_EQ(run.code, 0) << run.error;
  EXPECT_THAT(run.out, AllOf(HasSubstr("run.h5: dock run, complete"), HasSubstr("49 of 50 done"),
                             HasSubstr("receptor.pdb"), HasSubstr("shape, electrostatics"),
                             HasSubstr("seconds_search")));
  const nlohmann::json all = nlohmann::json::parse(mortise("info run.h5 --json").out);
  EXPECT_EQ(all["poses"]["count"], 12);
  EXPECT_EQ(all["provenance"]["options"]["spacing"], 2.0);
  EXPECT_EQ(all["fixed"]["knots"]["count"], 40);
  run_.complete = false;
  run_.poses.poses.clear();
  run_.metrics.clear();
  run_.candidates = testing::sample_candidates(9);
  write_run(scratch_ / "half.h5", run_);
  EXPECT_THAT(mortise("info half.h5").out,
              AllOf(HasSubstr("not finished"), HasSubstr("9 candidates")));
  expect_user_error("export half.h5 --format csv", "its search is not finished");
  KnotsFile knots;
  knots.source_path = "part.stl";
  knots.knots = run_.fixed.knots;
  write_knots_file(scratch_ / "k.h5", knots);
  EXPECT_THAT(mortise("info k.h5").out,
              AllOf(HasSubstr("k.h5: knots file"), HasSubstr("40 knots, radii")));
  const Outcome structure = mortise("info ligand.pdb");
  EXPECT_EQ(structure.code, 0) << structure.error;
  EXPECT_THAT(structure.out, AllOf(HasSubstr("atoms in 1 chains"), HasSubstr("residues")));
  EXPECT_EQ(nlohmann::json::parse(mortise("info ligand.pdb --json").out)["type"], "structure");
}

TEST_F(Program, InfoShowsPartsAndBalls) {
  std::ofstream(scratch_ / "cube.obj") << "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nv 0 0 2\nv 2 0 2\n"
                                          "v 2 2 2\nv 0 2 2\nf 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\n"
                                          "f 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
  const nlohmann::json part = nlohmann::json::parse(mortise("info cube.obj --json").out);
  EXPECT_EQ(part["type"], "part");
  EXPECT_EQ(part["triangles"], 12);
  EXPECT_TRUE(part["closed"].get<bool>());
  EXPECT_NEAR(part["volume"].get<double>(), 8.0, 1e-12);
  EXPECT_NEAR(part["diameter"].get<double>(), std::sqrt(12.0), 1e-9);
  EXPECT_THAT(mortise("info cube.obj").out, AllOf(HasSubstr("part, closed"), HasSubstr("volume")));
  std::ofstream(scratch_ / "two.xyzr") << "0 0 0 1\n1 0 0 2\n";
  EXPECT_THAT(mortise("info two.xyzr").out, HasSubstr("2 knots, radii 1.000 to 2.000"));
}

TEST_F(Program, InfoSaysWhatItCannotRead) {
  std::ofstream(scratch_ / "notes.txt") << "hello\n";
  expect_user_error("info notes.txt", "info reads run and knots files, meshes");
  expect_user_error("info none.pdb", "expected a file, found none");
  fs::resize_file(scratch_ / "run.h5", fs::file_size(scratch_ / "run.h5") / 2);
  expect_user_error("info run.h5", "truncated: expected");
  expect_user_error("info .", "directory");
}

}  // namespace
}  // namespace mortise
