// SPDX-License-Identifier: GPL-3.0-or-later
// The program on bodies of unlike kinds, from docking to the report, and runs ranked anew.
#include <filesystem>
#include <fstream>

#include "apps/program.hpp"

namespace mortise::testing {
namespace {

using ::testing::HasSubstr;

class Mixed : public Program {
 protected:
  Mixed() {
    std::ofstream balls(scratch_ / "pore.xyzr");
    balls << "# a ring of balls\n";
    for (int i = 0; i < 24; ++i) {
      const double a = 2.0 * 3.14159265 * i / 24;
      balls << 20.0 * std::cos(a) << ' ' << 20.0 * std::sin(a) << " 0 3\n";
    }
  }
};

TEST_F(Mixed, AMoleculeDocksToBallsAndGoesEverywhere) {
  const Outcome outcome = must("dock pore.xyzr 1hpv_ligand.pdb -o run.h5 --rotations 60 --poses 5");
  EXPECT_THAT(outcome.out, HasSubstr("receptor  pore.xyzr: 24 balls"));
  EXPECT_THAT(outcome.out, HasSubstr("mortise export run.h5 --format pdb --top 10"));
  must("export run.h5 --format pdb --top 2 -o poses.pdb");
  expect_user_error("export run.h5 --format pdb --complex -o poses.pdb",
                    "the fixed body of this dock run is balls");
  must("export run.h5 --format stl --pose 1 --complex -o pose.stl");
  expect_user_error("evaluate run.h5 --reference-fixed a.pdb --reference-moving b.pdb",
                    "--reference-pose");
  must("report run.h5 -o page");
  EXPECT_TRUE(std::filesystem::exists(scratch_ / "page/index.html"));
  const nlohmann::json info = json("info run.h5");
  EXPECT_EQ(info["fixed"]["kind"], "balls");
  EXPECT_EQ(info["candidates"], 240);
}

TEST_F(Mixed, RescoreRanksAnewAndRefusesWhatItCannot) {
  must("dock 1hpv_receptor.pdb 1hpv_ligand.pdb -o run.h5 --rotations 60 --poses 30");
  const nlohmann::json ranked =
      json("rescore run.h5 -o shape.h5 --no-rescore --no-polish --poses 7 --threads 1");
  EXPECT_EQ(ranked["candidates"], 240);
  EXPECT_EQ(ranked["poses"], 7);
  must(
      "dock 1hpv_receptor.pdb 1hpv_ligand.pdb -o direct.h5 --rotations 60 --poses 7 "
      "--no-rescore --no-polish --threads 1");
  EXPECT_EQ(datasets(read_run(path("shape.h5"))), datasets(read_run(path("direct.h5"))));
  expect_user_error("rescore run.h5 -o run.h5", "found an input");
  expect_user_error("rescore run.h5 -o shape.h5", "--force replaces it");
  expect_user_error("rescore run.h5 -o x.h5 --tolerance 0.1", "no option of a docking run");
  expect_user_error("rescore run.h5 -o x.h5 --poses many", "expected a whole number");
  expect_user_error("rescore run.h5 -o x.h5 --poses 0", "poses must be >= 1");
  expect_user_error("rescore run.h5 -o x.h5 --potential none.txt", "none.txt");
  std::filesystem::rename(scratch_ / "1hpv_ligand.pdb", scratch_ / "moved.pdb");
  expect_user_error("rescore run.h5 -o x.h5", "the run's moving input is not there");
  must("rescore run.h5 -o x.h5 --moving moved.pdb --quiet");
}

}  // namespace
}  // namespace mortise::testing
