// SPDX-License-Identifier: GPL-3.0-or-later
// A run's inputs are found where they were, by name or by contents, or are named in the error.
#include "mortise/report/bodies.hpp"

#include <gmock/gmock.h>

#include <filesystem>

#include "mortise/core/errors.hpp"
#include "mortise/parts/format_part.hpp"
#include "mortise/store/atomic_file.hpp"
#include "sample_report.hpp"

namespace mortise::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

namespace fs = std::filesystem;

class ReportInputs : public ::testing::Test {
 protected:
  ReportInputs() {
    for (const char* name : {"1hpv_receptor.pdb", "1hpv_ligand.pdb"})
      fs::copy_file(sample_molecule(name), scratch_ / name);
    fs::create_directory(scratch_.path() / "elsewhere");
    run_ = report_run(protease(), 1);
    run_.provenance.working_directory = scratch_.path().string();
    run_.fixed.path = run_.fixed.spec = "1hpv_receptor.pdb";
    run_.moving.path = run_.moving.spec = "1hpv_ligand.pdb";
    run_.fixed.sha256 = sha256_of_file(scratch_ / "1hpv_receptor.pdb");
    run_.moving.sha256 = sha256_of_file(scratch_ / "1hpv_ligand.pdb");
    places_.directories = {scratch_ / "elsewhere"};
  }

  void expect_error(const std::string& message) const {
    try {
      (void)read_report_bodies(run_, places_);
      FAIL() << "expected an error with " << message;
    } catch (const FileError& e) {
      EXPECT_THAT(e.what(), HasSubstr(message));
    }
  }

  tests::ScratchDirectory scratch_;
  mortise::Run run_;
  SearchPlaces places_;
};

TEST_F(ReportInputs, AreReadWhereTheyWere) {
  const ReportBodies bodies = read_report_bodies(run_);
  EXPECT_EQ(bodies.fixed.molecule.atoms.size(), 758u);
  EXPECT_EQ(report_points(bodies.moving).cols(), 758);
  EXPECT_THAT(bodies.notices, IsEmpty());
}

TEST_F(ReportInputs, AreFoundByContentsUnderAnyName) {
  fs::rename(scratch_ / "1hpv_receptor.pdb", scratch_ / "elsewhere/renamed.pdb");
  write_file_atomically(scratch_ / "elsewhere/1hpv_receptor.pdb", "HEADER    ANOTHER\n");
  const ReportBodies bodies = read_report_bodies(run_, places_);
  EXPECT_EQ(bodies.fixed.found, scratch_ / "elsewhere/renamed.pdb");
  EXPECT_EQ(bodies.fixed.molecule.atoms.size(), 758u);
  ASSERT_THAT(bodies.notices, SizeIs(1));
  EXPECT_THAT(bodies.notices[0], HasSubstr("1hpv_receptor.pdb was found by its SHA-256 at"));
}

TEST_F(ReportInputs, ThatChangedOrAreGoneAreNamed) {
  write_file_atomically(scratch_ / "1hpv_ligand.pdb", "HEADER    ANOTHER\n");
  expect_error("the run's moving input has changed");
  fs::remove(scratch_ / "1hpv_ligand.pdb");
  expect_error("1hpv_ligand.pdb: the run's moving input is not there");
  fs::rename(scratch_ / "1hpv_receptor.pdb", scratch_ / "elsewhere/of_another_kind.txt");
  expect_error("1hpv_receptor.pdb: the run's fixed input is not there");
}

TEST_F(ReportInputs, AreFoundBelowTheTreesToSearch) {
  fs::create_directories(scratch_.path() / "archive/2024/deep");
  fs::rename(scratch_ / "1hpv_receptor.pdb", scratch_ / "archive/2024/deep/renamed.pdb");
  write_file_atomically(scratch_ / "archive/1hpv_receptor.pdb", "HEADER    ANOTHER\n");
  places_.directories.push_back(scratch_ / "archive");  // not below: the error names the other one
  const std::string other = sha256_of_file(scratch_ / "archive/1hpv_receptor.pdb");
  expect_error("the run's fixed input is not there");
  expect_error("no file of SHA-256 " + run_.fixed.sha256 + " in " + (scratch_ / "elsewhere"));
  expect_error("archive/1hpv_receptor.pdb has the name but SHA-256 " + other);
  places_.trees = {scratch_ / "archive"};
  const ReportBodies bodies = read_report_bodies(run_, places_);
  EXPECT_EQ(bodies.fixed.found, scratch_ / "archive/2024/deep/renamed.pdb");
  places_.trees = {scratch_ / "nowhere"};
  EXPECT_THROW((void)read_report_bodies(run_, places_), InputError);
}

TEST_F(ReportInputs, ThatChangedAreNamedWithBothSums) {
  write_file_atomically(scratch_ / "1hpv_ligand.pdb", "HEADER    ANOTHER\n");
  expect_error(run_.moving.sha256.substr(0, 12) + "..., found " +
               sha256_of_file(scratch_ / "1hpv_ligand.pdb").substr(0, 12));
}

TEST_F(ReportInputs, MayBeMissingWhereTheUserSaysSo) {
  fs::remove(scratch_ / "1hpv_ligand.pdb");
  places_.allow_missing = true;
  run_.moving.knots.points = Eigen::Matrix4Xd::Ones(4, 3);
  run_.moving.knots.weights = Eigen::VectorXcd::Ones(3);
  const ReportBodies bodies = read_report_bodies(run_, places_);
  EXPECT_TRUE(bodies.moving.is_missing());
  EXPECT_FALSE(bodies.fixed.is_missing());
  EXPECT_EQ(report_points(bodies.moving).cols(), 3);
  ASSERT_THAT(bodies.notices, SizeIs(1));
  EXPECT_THAT(bodies.notices[0], HasSubstr("1hpv_ligand.pdb: the run's moving input is not there"));
  write_file_atomically(scratch_ / "1hpv_ligand.pdb", "no molecule");
  run_.moving.sha256 = sha256_of_file(scratch_ / "1hpv_ligand.pdb");
  EXPECT_THROW((void)read_report_bodies(run_, places_), InputError) << "a file that cannot be read";
}

TEST_F(ReportInputs, OfPartsAreMeshes) {
  const ReportBodies made = plate_and_pin();
  write_file_atomically(scratch_ / "plate.stl", format_stl(made.fixed.mesh));
  write_file_atomically(scratch_ / "pin.stl", format_stl(made.moving.mesh));
  run_.kind = "mate";
  run_.fixed.kind = run_.moving.kind = "part";
  run_.fixed.path = run_.fixed.spec = "plate.stl";
  run_.moving.path = run_.moving.spec = "pin.stl";
  run_.fixed.sha256 = sha256_of_file(scratch_ / "plate.stl");
  run_.moving.sha256 = sha256_of_file(scratch_ / "pin.stl");
  const ReportBodies bodies = read_report_bodies(run_);
  ASSERT_TRUE(bodies.moving.is_mesh());
  EXPECT_EQ(bodies.fixed.mesh.size(), made.fixed.mesh.size());
  EXPECT_EQ(bodies.moving.mesh.size(), made.moving.mesh.size());
}

TEST_F(ReportInputs, AreNotSearchedForWhereTheUserSaysWhereTheyAre) {
  places_.fixed.path = scratch_ / "1hpv_ligand.pdb";
  expect_error("the run's fixed input has changed");
  places_.fixed.force = true;
  EXPECT_EQ(read_report_bodies(run_, places_).fixed.found, scratch_ / "1hpv_ligand.pdb");
}

}  // namespace
}  // namespace mortise::testing
