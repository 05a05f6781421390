// SPDX-License-Identifier: GPL-3.0-or-later
// mortise mate as a user runs it: output, evaluation, export, threads, going on, errors.
#include "mortise/runs/mate.hpp"

#include <csignal>
#include <filesystem>

#include "apps/program.hpp"
#include "mortise/metrics/true_mates.hpp"
#include "mortise/parts/read_part.hpp"

namespace mortise {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using testing::datasets;
using ::testing::HasSubstr;
using testing::Outcome;

class Mate : public testing::Program {
 protected:
  Mate() {
    for (const char* file :
         {"dovetail_socket_close.stl", "dovetail_tail.stl", "dovetail_tail.step", "mates.json"})
      fs::copy_file(fs::path(MORTISE_SOURCE_DIR) / "parts" / file, scratch_ / file);
  }
  // The flat faces alone give the right rotation: one of SO(3) is enough.
  static std::string mate(const std::string& output, const std::string& further = "") {
    return "mate dovetail_socket_close.stl dovetail_tail.stl -o " + output +
           " --rotations 1 --polished 20 --poses 20 --samples 1000 --check 1 " + further;
  }
};

TEST_F(Mate, FindsADovetailFromARandomStartAndGoesOnWithIt) {
  const Outcome outcome = must(mate("run.h5", "--random-start 3"));
  EXPECT_THAT(outcome.out,
              AllOf(HasSubstr("fixed     dovetail_socket_close.stl"), HasSubstr("wrote run.h5"),
                    HasSubstr("contact_area"), HasSubstr("moved at random by seed 3")));
  const nlohmann::json found = json("evaluate run.h5 --reference-pose mates.json");
  EXPECT_EQ(found["first_within_2_percent"], 1);
  EXPECT_LT(found["error_of_first"], 0.005);
  EXPECT_EQ(found["pair"], "dovetail_close");
  const mortise::Run run = read_run(path("run.h5"));
  EXPECT_EQ(run.kind, "mate");
  EXPECT_EQ(run.poses.channel_names, (std::vector<std::string>{"contact", "penetration"}));
  ASSERT_EQ(run.metrics.size(), 9U);
  EXPECT_EQ(run.metrics[0].name, "contact_area");
  EXPECT_GT(run.metrics[0].values[0], 0.0);
  EXPECT_EQ(run.metrics[7].name, "placement_largest");

  // Every format, the moved part where the pose says.
  const TriangleMesh moving = read_part(path("dovetail_tail.stl")).mesh;
  const Eigen::Matrix3Xd placed = run.poses.poses.front().moving_in_fixed * moving.vertices;
  for (const char* format : {"stl", "ply", "step"}) {
    must(std::string("export run.h5 --format ") + format + " -o out." + format);
    const TriangleMesh mesh = read_part(path(std::string("out.") + format)).mesh;
    EXPECT_LT((mesh.vertices.rowwise().minCoeff() - placed.rowwise().minCoeff()).norm(), 1e-3)
        << format;
    EXPECT_LT((mesh.vertices.rowwise().maxCoeff() - placed.rowwise().maxCoeff()).norm(), 1e-3)
        << format;
  }
  must("export run.h5 --format stl --complex --top 2 -o both.stl");
  EXPECT_TRUE(fs::exists(path("both_1.stl")) && fs::exists(path("both_2.stl")));
  expect_user_error("export run.h5 --format pdb", "for molecules");
  expect_user_error("evaluate run.h5 --reference-fixed a.pdb --reference-moving b.pdb",
                    "--reference-pose");
}

TEST_F(Mate, ExportOverwritesNoInputByANumberedName) {
  fs::copy_file(path("dovetail_tail.stl"), path("b_2.stl"));
  must(
      "mate dovetail_socket_close.stl b_2.stl -o run.h5 --rotations 1 --polished 20 --poses 20 "
      "--samples 1000 --check 0 --quiet");
  const std::string before = read_whole_file(path("b_2.stl"));
  expect_user_error("export run.h5 --format stl --top 2 -o b.stl", "b_2.stl");
  EXPECT_EQ(read_whole_file(path("b_2.stl")), before);
  EXPECT_FALSE(fs::exists(path("b_1.stl")));  // nothing is written before all names are good
  must("export run.h5 --format stl --top 2 -o c.stl");
  EXPECT_TRUE(fs::exists(path("c_1.stl")) && fs::exists(path("c_2.stl")));
  expect_user_error("export run.h5 --format stl --top 2 -o -", "--pose");

  // What does nothing for parts is refused; a truth without names takes the run's.
  expect_user_error("evaluate run.h5 --mates mates.json --fixed b_2.stl", "--fixed");
  expect_user_error("evaluate run.h5 --mates mates.json --interface 3", "--interface");
  expect_user_error("evaluate run.h5 --mates mates.json --reference-fixed a.pdb",
                    "--reference-fixed");
  write_file_atomically(path("one.json"),
                        R"({"pose": {"rotation": [1, 0, 0, 0], "translation": [0, 0, 0]}})");
  EXPECT_EQ(json("evaluate run.h5 --mates one.json")["pair"], "dovetail_socket_close b_2");
}

TEST_F(Mate, UnitsOfStepFilesAreComparedAndKept) {
  // The same solid, its file in centimetres.
  std::string step = read_whole_file(path("dovetail_tail.step"));
  const std::size_t at = step.find(".MILLI.");
  ASSERT_NE(at, std::string::npos);
  write_file_atomically(path("centi.step"), step.replace(at, 7, ".CENTI."));
  expect_user_error("mate dovetail_tail.step centi.step -o run.h5", "in cm");
  EXPECT_FALSE(fs::exists(path("run.h5")));
  for (const char* file : {"round_peg_pin.step", "round_peg_hole_close.stl"})
    fs::copy_file(fs::path(MORTISE_SOURCE_DIR) / "parts" / file, scratch_ / file);
  const nlohmann::json found = json(
      "mate round_peg_hole_close.stl round_peg_pin.step -o run.h5 --deviation 0.5 "
      "--rotations 1 --aligned 1 --turns 0 --polished 5 --poses 5 --samples 500 --check 0");
  EXPECT_THAT(found["decisions"].dump(), HasSubstr("taken as mm"));
  const mortise::Run run = read_run(path("run.h5"));
  EXPECT_EQ(run.fixed.unit, "");
  EXPECT_EQ(run.moving.unit, "mm");
  // Exported on the mesh that the run used, not on the finer one that is the default.
  must("export run.h5 --format stl --pose 1 -o out.stl");
  const Eigen::Index used =
      read_part(path("round_peg_pin.step"), {.absolute_deviation = 0.5}).mesh.size();
  EXPECT_EQ(read_part(path("out.stl")).mesh.size(), used);
  EXPECT_GT(read_part(path("round_peg_pin.step")).mesh.size(), used);
}

TEST_F(Mate, SaysWhereTheGridIsCoarserThanAsked) {
  const nlohmann::json found = json(mate("run.h5", "--most-cells 5000"));
  EXPECT_THAT(found["decisions"].dump(), HasSubstr("--most-cells 5000"));
}

TEST_F(Mate, CtrlCIsObeyedWhileRankingAndNothingOfTheSearchIsLost) {
  must(mate("whole.h5", "--quiet"));
  // The search is over when its file appears: what remains is ranking.
  const pid_t process = start(mate("run.h5", "--threads 1 --checkpoint 1000"));
  ASSERT_TRUE(wait_for("run.h5"));
  ::kill(process, SIGINT);
  const Outcome stopped = finish(process);
  ASSERT_EQ(stopped.code, 130) << stopped.error;
  EXPECT_THAT(stopped.error, HasSubstr("the search is in run.h5; go on with"));
  const mortise::Run part = read_run(path("run.h5"));
  EXPECT_FALSE(part.complete);
  ASSERT_FALSE(part.candidates.empty());
  for (const std::uint8_t done : part.rotations.done) EXPECT_EQ(done, 1);
  must("mate -o run.h5 --resume --quiet");
  EXPECT_EQ(datasets(read_run(path("run.h5"))), datasets(read_run(path("whole.h5"))));
}

TEST_F(Mate, JsonHasTheKeysScriptsRelyOn) {
  const nlohmann::json json = this->json(mate("run.h5", "--axis 0,0,1:0,0,1"));
  for (const char* key :
       {"rotations", "poses", "seconds", "best_score", "seconds_describe", "peak_memory_mb"})
    EXPECT_TRUE(json.contains(key)) << key;
  EXPECT_EQ(json["rotations"], 2);
}

TEST_F(Mate, ThreadsAndInterruptionsChangeNothing) {
  must(mate("one.h5", "--threads 1"));
  must(mate("three.h5", "--threads 3"));
  const std::string expected = datasets(read_run(path("one.h5")));
  EXPECT_EQ(datasets(read_run(path("three.h5"))), expected);
  const pid_t process = start(mate("cut.h5", "--threads 1 --checkpoint 0"));
  if (wait_for("cut.h5")) ::kill(process, SIGKILL);
  (void)finish(process);
  must("mate -o cut.h5 --resume");
  EXPECT_EQ(datasets(read_run(path("cut.h5"))), expected);
  must("mate -o cut.h5 --resume --quiet");  // complete: nothing to do
  expect_user_error("mate -o cut.h5 --resume --spacing 0.5", "spacing differs");
  expect_user_error("dock -o cut.h5 --resume", "mate run");
}

TEST_F(Mate, ClearancesAreToldWhereverARunIs) {
  const Outcome outcome = must(
      "mate dovetail_socket_close.stl dovetail_tail.stl -o run.h5 --rotations 1 --polished 5 "
      "--poses 5 --samples 1000 --check 0 --knots balls --ball-step 0.03 --distance-spacing 0.02 "
      "--clearances 0:0.1:0.2");
  EXPECT_THAT(outcome.out, AllOf(HasSubstr(" fits best\n"), HasSubstr("best score")));
  EXPECT_THAT(outcome.out, HasSubstr("  clearance contact_area"));
  const nlohmann::json info = json("info run.h5");
  ASSERT_EQ(info["clearances"].size(), 3U);
  EXPECT_EQ(info["clearances"][2]["clearance"], 0.2);
  EXPECT_FALSE(info["figures"].contains("score_at_clearance_0.2"));
  EXPECT_THAT(must("info run.h5").out, HasSubstr(" fits best; best score by clearance:"));
  // The socket is 0.5% wider than the tail: thicker than by 0.1 mm a side it does not go in.
  const double best = info["best_clearance"];
  EXPECT_LT(best, 0.2);
  const mortise::Run run = read_run(path("run.h5"));
  EXPECT_EQ(run.metrics.front().name, "clearance");
  EXPECT_EQ(run.metrics.front().values.front(), best);
  EXPECT_EQ(info["clearances"][best == 0.0 ? 0 : 1]["best_score"], run.poses.poses.front().score);
  // Ranked anew, the same; gone on with, only as it was begun.
  const nlohmann::json again = json("rescore run.h5 -o again.h5");
  EXPECT_EQ(again["clearances"], info["clearances"]);
  EXPECT_EQ(again["best_clearance"], best);
  must("mate -o run.h5 --resume --clearances 0,0.1,0.2 --quiet");
  expect_user_error("mate -o run.h5 --resume --clearances 0:0.1:0.3", "clearances differs");
  must("export run.h5 --format csv -o poses.csv");
  EXPECT_THAT(read_whole_file(path("poses.csv")), HasSubstr(",clearance,"));
  must("report run.h5 -o page");
  EXPECT_THAT(read_whole_file(path("page/poses.csv")), HasSubstr(",clearance,"));
  expect_user_error(mate("no.h5", "--clearances 0:0.1:0.2"), "need --knots balls");
  expect_user_error(mate("no.h5", "--knots balls --clearances 0:0.1"),
                    "--clearances: expected MIN");
}

// Two parts taken apart by one command and mated by the next. Balls that stay inside their parts
// (--expansion 0) leave no overlap where the parts touch.
class MateSlow : public Mate {};

TEST_F(MateSlow, FilesOfDecomposeFindTheMateOfTheirParts) {
  for (const char* part : {"ball_cup_exact", "ball"})
    must(std::string("decompose ") + MORTISE_SOURCE_DIR + "/parts/" + part + ".stl -o " + part +
         ".h5 --grid 48 --expansion 0 --weights share --no-hausdorff --quiet");
  const Outcome outcome = must(
      "mate ball_cup_exact.h5 ball.h5 -o run.h5 --knots balls --random-start 3 --rotations 1 "
      "--axis 0,0,1:0,0,1 --spacing 0.04 --skin 0.06 --distance-spacing 0.02 --tolerance 0.01 "
      "--samples 1000 --polished 20 --check 0");
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("moving    ball.h5: "), HasSubstr(" balls\n")));
  const nlohmann::json found =
      json("evaluate run.h5 --reference-pose mates.json --pair ball_socket_exact");
  EXPECT_EQ(found["first_within_2_percent"], 1);
  EXPECT_LT(found["error_of_first"], 0.015);
  const mortise::Run run = read_run(path("run.h5"));
  EXPECT_EQ(run.fixed.kind, "balls");
  EXPECT_GT(run.poses.poses.front().score, 0.2);
}

TEST_F(Mate, SaysWhatIsWrong) {
  expect_user_error("mate dovetail_tail.stl -o run.h5", "expected two inputs");
  expect_user_error("mate dovetail_tail.stl none.stl -o run.h5", "none.stl");
  expect_user_error(mate("run.h5", "--spacing 0"), "spacing");
  expect_user_error(mate("run.h5", "--penetration-weight inf"), "penetration_weight must be >= 0");
  EXPECT_FALSE(fs::exists(path("run.h5")));
  EXPECT_THAT(must("mate --help").out, HasSubstr("its diagonal times 0.0005"));
  expect_user_error(mate("run.h5", "--axis 1,2"), "--axis");
  expect_user_error("mate dovetail_tail.stl mates.json -o dovetail_tail.stl --force", "an input");
}

}  // namespace
}  // namespace mortise
