// SPDX-License-Identifier: GPL-3.0-or-later
// mortise collide and mortise assemble on small parts and a molecule.
#include <Eigen/Geometry>
#include <csignal>
#include <filesystem>
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
  EXPECT_EQ(json["by_sum"], 0);
  // The common volume of the cubes as they are, by a thousand modes.
  EXPECT_NEAR(json["poses"][0]["gap"].get<double>(), 0.5 * 0.8, 0.05);
  EXPECT_NEAR(json["poses"][1]["gap"].get<double>(), 0.0, 0.02);
  // Farther along x they overlap less.
  EXPECT_LT(json["poses"][0]["translation_gradient"][0].get<double>(), 0.0);
  std::ifstream csv(path("out.csv"));
  std::string line;
  std::getline(csv, line);
  EXPECT_EQ(line, "pose,answer,by,gap,dx,dy,dz,ex,ey,ez,modes");
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
  EXPECT_EQ(json["in_band"], 0);
}

// A molecule and a part, or balls of a file: any with any.
TEST_F(PartPrograms, CollideTakesBodiesOfTwoKinds) {
  must("decompose cube.obj -o cube.h5 --grid 16 --no-hausdorff");
  const nlohmann::json balls =
      this->json("collide cube.obj cube.h5 --poses poses.csv --grid 32 --modes 500");
  EXPECT_EQ(balls["poses"][0]["answer"], "yes");
  EXPECT_EQ(balls["poses"][1]["answer"], "no");
  std::ofstream(path("atom.csv")) << "qw,qx,qy,qz,tx,ty,tz\n1,0,0,0,300,0,0\n";
  const nlohmann::json molecule =
      this->json("collide 1hpv_ligand.pdb cube.obj --poses atom.csv --modes 500");
  EXPECT_EQ(molecule["poses"][0]["answer"], "no");
}

// The truncated sum alone never says what the trees deny, and stops early where bodies are far.
TEST_F(PartPrograms, CollideByTheSumAlone) {
  std::ofstream poses(path("line.csv"));
  poses << "qw,qx,qy,qz,tx,ty,tz\n";
  for (int i = 0; i < 60; ++i) poses << "1,0,0,0," << 0.1 * i << ",0.3,0\n";
  poses.close();
  const std::string command = "collide cube.obj cube.obj --poses line.csv --grid 32 --modes 4096 ";
  const nlohmann::json trees = this->json(command);
  const nlohmann::json sum = this->json(command + "--certificate sum");
  EXPECT_EQ(sum["by_sum"], 60);
  EXPECT_EQ(sum["yes"], 0);
  EXPECT_GT(sum["no"], 5);
  const double band = sum["sum_band"].get<double>();
  int early = 0;
  for (int i = 0; i < 60; ++i) {
    const auto &by_sum = sum["poses"][i], &by_trees = trees["poses"][i];
    if (by_sum["answer"] == "no") {
      EXPECT_NE(by_trees["answer"], "yes") << i;
    } else {
      EXPECT_LE(0.1 * i - 1.0, band) << i;  // what is farther apart is told apart
    }
    early += by_sum["modes"].get<int>() < 4096 / 2 ? 1 : 0;
  }
  EXPECT_GT(early, 0);
  EXPECT_LT(sum["mean_modes"].get<double>(), 4096.0);
}

// Its balls stand about places outside: plates like it were refused once.
TEST_F(PartPrograms, CollideTakesAThinTurnedPlate) {
  std::ofstream plate(path("plate.obj"));
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()));
  for (int corner = 0; corner < 8; ++corner)
    plate << "v "
          << (turn * Eigen::Vector3d((corner & 1) != 0 ? 50 : -50, (corner & 2) != 0 ? 40 : -40,
                                     (corner & 4) != 0 ? 0.5 : -0.5))
                 .transpose()
          << '\n';
  plate << "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
  plate.close();
  const nlohmann::json json =
      this->json("collide plate.obj cube.obj --poses poses.csv --modes 500");
  EXPECT_NE(json["poses"][0]["answer"], "no");
}

TEST_F(PartPrograms, CollideChecksItsFilesFirst) {
  const std::string poses = read_whole_file(path("poses.csv"));
  expect_user_error("collide cube.obj cube.obj --poses poses.csv -o poses.csv", "found an input");
  expect_user_error("collide cube.obj cube.obj --poses poses.csv -o cube.obj", "found an input");
  EXPECT_EQ(read_whole_file(path("poses.csv")), poses);
  // Before the poses are read, let alone answered.
  expect_user_error("collide cube.obj cube.obj --poses none.csv -o none/a.csv", "none/a.csv");
  must("collide 1hpv_ligand.pdb cube.obj --poses poses.csv --quiet");  // any body with any
}

TEST_F(PartPrograms, CtrlCIsHeard) {
  {
    std::ofstream many(path("many.csv"));
    many << "qw,qx,qy,qz,tx,ty,tz\n";
    for (int i = 0; i < 300000; ++i) many << "1,0,0,0,1.01,0,0\n";
    std::ofstream(path("slow.csv")) << "qw,qx,qy,qz,tx,ty,tz\n1,0,0,0,1,0,0\n1,0,0,0,1,0,0\n";
  }
  for (const char* arguments :
       {"collide cube.obj cube.obj --poses many.csv -o never.csv --modes 20000 --threads 1",
        "assemble cube.obj cube.obj --path slow.csv --rate 0.01 --grid 16 --modes 200"}) {
    const pid_t process = start(arguments);
    std::this_thread::sleep_for(std::chrono::seconds(2));
    const auto sent = std::chrono::steady_clock::now();
    ::kill(process, SIGINT);
    EXPECT_EQ(finish(process).code, 130) << arguments;
    EXPECT_LT(std::chrono::steady_clock::now() - sent, std::chrono::seconds(40)) << arguments;
  }
  EXPECT_FALSE(std::filesystem::exists(path("never.csv")));
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
  // Steps out of reach cost nothing and are not counted.
  std::ofstream(path("far.csv")) << "qw,qx,qy,qz,tx,ty,tz\n1,0,0,0,1,0,0\n1,0,0,0,99,0,0\n";
  const nlohmann::json far =
      this->json("assemble cube.obj cube.obj --path far.csv --grid 24 --modes 500");
  EXPECT_EQ(far["steps"], 2);
  EXPECT_EQ(far["compute_microseconds"]["steps"], 1);
  EXPECT_GT(far["compute_microseconds"]["median"].get<double>(), 0.0);
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

TEST_F(PartPrograms, AssembleTakesAnyBodyWithAny) {
  // The cube as eight balls, one at each corner, and as what decompose makes of it.
  {
    std::ofstream balls(path("cube.xyzr"));
    for (int corner = 0; corner < 8; ++corner)
      balls << 0.5 * (corner & 1) - 0.25 << ' ' << 0.25 * (corner & 2) - 0.25 << ' '
            << 0.125 * (corner & 4) - 0.25 << " 0.3\n";
  }
  must("decompose cube.obj -o cube.h5 --grid 24 --expansion 0 --no-hausdorff --quiet");
  const std::string further = " --goal goal.csv --seconds 0.05 --grid 24 --modes 500 -o ";
  const auto peak = [&](const std::string& name) {
    double largest = 0.0;
    std::ifstream csv(path(name));
    std::string line;
    std::getline(csv, line);
    while (std::getline(csv, line))
      largest = std::max(largest, std::abs(std::stod(line.substr(line.find(',') + 1))));
    return largest;
  };
  const nlohmann::json meshes = json("assemble cube.obj cube.obj" + further + "meshes.csv");
  for (const char* moving : {"cube.xyzr", "cube.h5"}) {
    const nlohmann::json mixed =
        json(std::string("assemble cube.obj ") + moving + further + "mixed.csv");
    EXPECT_EQ(mixed["steps"], meshes["steps"]);
    // Less is filled by the balls, but it is the same cube.
    EXPECT_GT(peak("mixed.csv"), 0.2 * peak("meshes.csv")) << moving;
    EXPECT_LT(peak("mixed.csv"), 1.5 * peak("meshes.csv")) << moving;
  }
  EXPECT_THAT(must("assemble cube.xyzr cube.obj" + further + "a.csv").out,
              HasSubstr("bodies       8 balls and 12 triangles"));
  EXPECT_THAT(must("assemble cube.h5 cube.xyzr --field skeletal" + further + "a.csv").out,
              HasSubstr(" and 8 balls"));
  EXPECT_THAT(must("assemble 1hpv_ligand.pdb cube.obj" + further + "a.csv").out,
              HasSubstr(" atoms and 12 triangles"));
  EXPECT_EQ(
      json("assemble cube.h5 cube.h5 --goal goal.csv --free 2 --grid 24 --modes 500")["starts"], 2);
  expect_user_error("assemble cube.xyzr:A cube.obj" + further + "a.csv", "cube.xyzr");
  expect_user_error("assemble cube.h5 cube.obj --goal goal.csv -o cube.h5", "found an input");
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
  const std::string free = "assemble cube.obj cube.obj --goal goal.csv --free 2 ";
  EXPECT_EQ(mortise(free + "--plot a.svg").code, 1);
  EXPECT_EQ(mortise(free + "--write-path a.csv").code, 1);
  expect_user_error(free + "--start-shift nan", "--start-shift");
  expect_user_error(free + "--start-angle -1", "--start-angle");
  expect_user_error(free + "--thickness -1", "--thickness");
  expect_user_error(free + "--thickness nan", "--thickness");
  expect_user_error("assemble cube.obj cube.obj --goal goal.csv -o goal.csv", "found an input");
  const std::string small = "assemble cube.obj cube.obj --grid 16 --modes 200 --quiet ";
  expect_user_error(small + "--goal goal.csv --seconds 1e15", "seconds times rate");
  std::ofstream(path("empty.csv")) << "qw,qx,qy,qz,tx,ty,tz\n";
  expect_user_error(small + "--path empty.csv", "holds no pose");
}

}  // namespace
}  // namespace mortise
