// SPDX-License-Identifier: GPL-3.0-or-later
// mortise collide and mortise assemble on small parts and a molecule.
#include <fstream>

#include "apps/program.hpp"

namespace mortise {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using testing::Outcome;

class PartPrograms : public testing::Program {
 protected:
  // A unit cube about the origin as OBJ, and three poses of a second one.
  PartPrograms() {
    std::ofstream cube(path("cube.obj"));
    for (int corner = 0; corner < 8; ++corner)
      cube << "v " << ((corner & 1) != 0 ? 0.5 : -0.5) << ' ' << ((corner & 2) != 0 ? 0.5 : -0.5)
           << ' ' << ((corner & 4) != 0 ? 0.5 : -0.5) << '\n';
    cube << "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
    std::ofstream poses(path("poses.csv"));
    poses << "rank,qw,qx,qy,qz,tx,ty,tz\n1,1,0,0,0,0.5,0.2,0\n2,1,0,0,0,1.9,0,0\n3,1,0,0,0,1.01,0,"
             "0\n";
    std::ofstream goal(path("goal.csv"));
    goal << "qw,qx,qy,qz,tx,ty,tz\n1,0,0,0,1,0,0\n";
  }
};

TEST_F(PartPrograms, CollideAnswersYesNoAndBand) {
  const nlohmann::json json =
      this->json("collide cube.obj cube.obj --poses poses.csv --grid 32 --modes 1000 -o out.csv");
  ASSERT_EQ(json["poses"].size(), 3U);
  EXPECT_EQ(json["poses"][0]["answer"], "yes");
  EXPECT_EQ(json["poses"][1]["answer"], "no");
  EXPECT_EQ(json["poses"][2]["answer"], "band");  // 0.01 apart, the band is several cells
  EXPECT_GT(json["poses"][0]["gap"].get<double>(), json["poses"][2]["gap"].get<double>());
  // Farther along x they overlap less.
  EXPECT_LT(json["poses"][0]["translation_gradient"][0].get<double>(), 0.0);
  std::ifstream csv(path("out.csv"));
  std::string line;
  std::getline(csv, line);
  EXPECT_EQ(line, "pose,answer,by,gap,dx,dy,dz,ex,ey,ez");
  std::getline(csv, line);
  EXPECT_THAT(line, HasSubstr("1,yes,tree,"));
}

TEST_F(PartPrograms, CollideOfMoleculesIsExact) {
  std::ofstream(path("self.csv")) << "qw,qx,qy,qz,tx,ty,tz\n1,0,0,0,0,0,0\n1,0,0,0,300,0,0\n";
  const nlohmann::json json =
      this->json("collide 1hpv_ligand.pdb 1hpv_ligand.pdb --poses self.csv --modes 1000");
  EXPECT_EQ(json["poses"][0]["answer"], "yes");
  EXPECT_EQ(json["poses"][1]["answer"], "no");
  EXPECT_EQ(json["band"], 0.0);
}

TEST_F(PartPrograms, AssembleFollowsAPathAndLetsGo) {
  const nlohmann::json path_figures = this->json(
      "assemble cube.obj cube.obj --goal goal.csv --seconds 0.2 --grid 24 --modes 500 -o "
      "wrench.csv "
      "--plot wrench.svg --write-path path.csv");
  EXPECT_EQ(path_figures["steps"], 200);
  EXPECT_GT(path_figures["compute_microseconds"]["median"].get<double>(), 0.0);
  std::ifstream csv(path("wrench.csv"));
  std::string line;
  int lines = 0;
  while (std::getline(csv, line)) ++lines;
  EXPECT_EQ(lines, 201);
  std::ifstream svg(path("wrench.svg"));
  std::getline(svg, line);
  EXPECT_THAT(line, HasSubstr("<svg"));
  // The path kept gives the same wrenches.
  const nlohmann::json again = this->json(
      "assemble cube.obj cube.obj --path path.csv --rate 5000 --grid 24 --modes 500 -o again.csv");
  EXPECT_EQ(again["steps"], 200);
  const nlohmann::json free =
      this->json("assemble cube.obj cube.obj --goal goal.csv --free 3 --grid 24 --modes 500");
  EXPECT_EQ(free["starts"], 3);
  EXPECT_LT(free["mate_energy"].get<double>(), 0.0);
}

// A round peg may turn in its hole: such rests are at home by the truth's symmetries alone.
TEST_F(PartPrograms, AssembleCountsTheMatesSymmetries) {
  for (const char* file : {"round_peg_hole_exact.stl", "round_peg_pin.stl", "mates.json"})
    std::filesystem::copy_file(std::filesystem::path(MORTISE_SOURCE_DIR) / "parts" / file,
                               scratch_ / file);
  const std::string command =
      "assemble round_peg_hole_exact.stl round_peg_pin.stl --mates mates.json --free 6 --seed 3 "
      "--start-shift 0.05 --start-angle 20 --grid 32 --modes 1500 ";
  const nlohmann::json turned = this->json(command);
  EXPECT_GE(turned["home"].get<int>(), 5);
  EXPECT_LE(turned["home_without_symmetries"].get<int>(), 2);
  expect_user_error(command + "--goal goal.csv", "one of --path, --goal and --mates");
  expect_user_error(command + "--pair nonesuch", "'nonesuch'");
}

TEST_F(PartPrograms, BadInputIsNamed) {
  std::ofstream(path("bad.csv")) << "qw,qx,qy,qz,tx,ty\n1,0,0,0,0,0\n";
  Outcome outcome = mortise("collide cube.obj cube.obj --poses bad.csv");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.error, AllOf(HasSubstr("bad.csv:1"), HasSubstr("column tz")));
  std::ofstream(path("worse.csv")) << "qw,qx,qy,qz,tx,ty,tz\n1,0,0,0,0,0,zero\n";
  outcome = mortise("collide cube.obj cube.obj --poses worse.csv");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.error, AllOf(HasSubstr("worse.csv:2"), HasSubstr("\"zero\"")));
  outcome = mortise("assemble cube.obj cube.obj");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.error, HasSubstr("one of --path, --goal and --mates"));
}

}  // namespace
}  // namespace mortise
