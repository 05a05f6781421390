// SPDX-License-Identifier: GPL-3.0-or-later
// mortise dock as a user runs it: output, run file, threads, Ctrl-C and going on, errors.
#include "mortise/runs/dock.hpp"

#include <cmath>
#include <csignal>
#include <filesystem>
#include <numeric>
#include <set>

#include "apps/program.hpp"
#include "mortise/core/rigid_motion.hpp"
#include "mortise/molecules/read_molecule.hpp"

namespace mortise {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using testing::datasets;
using ::testing::HasSubstr;
using testing::Outcome;

constexpr const char* kPair = "1hpv_receptor.pdb 1hpv_ligand.pdb ";

class Dock : public testing::Program {
 protected:
  // A run long enough to be stopped: about a second of one core.
  static std::string long_run(const std::string& output, int rotations = 3600) {
    return std::string("dock ") + kPair + "-o " + output + " --rotations " +
           std::to_string(rotations) + " --spacing 2.5 --random-start 3 --threads 1";
  }
};

TEST_F(Dock, WritesACompleteRunAndSaysHowToGoOn) {
  const Outcome outcome = must(std::string("dock ") + kPair + "-o run.h5 --rotations 60");
  EXPECT_THAT(outcome.out,
              AllOf(HasSubstr("receptor  1hpv_receptor.pdb: 758 atoms"),
                    HasSubstr("60 of 60 rotations"), HasSubstr("\n     1 "), HasSubstr("\n    10 "),
                    HasSubstr("wrote run.h5"), HasSubstr("mortise export run.h5 --format pdb")));
  EXPECT_THAT(outcome.out, ::testing::Not(HasSubstr("\n    11 ")));
  EXPECT_EQ(outcome.error, "");
  const mortise::Run run = read_run(path("run.h5"));
  EXPECT_TRUE(run.complete);
  EXPECT_EQ(run.candidates.size(), 240U);  // four a rotation, to rank anew
  EXPECT_EQ(run.rotations.done, std::vector<std::uint8_t>(60, 1));
  ASSERT_GT(run.poses.poses.size(), 10U);
  for (std::size_t i = 1; i < run.poses.poses.size(); ++i)
    EXPECT_LE(run.poses.poses[i].score, run.poses.poses[i - 1].score);
  EXPECT_EQ(run.provenance.command_line,
            std::string("mortise dock ") + kPair + "-o run.h5 --rotations 60");
  // The command it names works on what it wrote.
  must("export run.h5 --format pdb --top 10 --complex");
  EXPECT_EQ(must(std::string("dock ") + kPair + "-o quiet.h5 --rotations 60 --quiet").out, "");
}

TEST_F(Dock, JsonHasTheKeysScriptsRelyOn) {
  const nlohmann::json json = this->json(std::string("dock ") + kPair + "-o run.h5 --rotations 60");
  EXPECT_EQ(json["rotations"], 60);
  const mortise::Run run = read_run(path("run.h5"));
  EXPECT_EQ(json["poses"], run.poses.poses.size());
  EXPECT_EQ(json["best_score"], run.poses.poses.front().score);
  EXPECT_EQ(json["grid"].size(), 3U);
  EXPECT_EQ(json["complete"], true);
  for (const char* key : {"seconds", "spacing", "threads", "seconds_read", "seconds_search",
                          "seconds_rank", "peak_memory_mb"})
    EXPECT_GT(json[key].get<double>(), 0.0) << key;
  EXPECT_GE(json["seconds"].get<double>(),
            json["seconds_search"].get<double>() + json["seconds_rank"].get<double>());
  std::set<std::string> figures;
  for (const Figure& figure : run.figures) figures.insert(figure.name);
}

TEST_F(Dock, OptionsGoOverThePresetAndAreRecorded) {
  must(std::string("dock ") + kPair +
       "-o run.h5 --spacing 4 --preset fast --rotations 60 --poses 7 --penalty 5.5 --no-ions");
  const mortise::Run run = read_run(path("run.h5"));
  DockOptions expected = dock_preset("fast");
  expected.search.spacing = 4.0;
  expected.rotations = 60;
  expected.poses = 7;
  expected.double_skin.penalty = 5.5;
  nlohmann::json json = nlohmann::json::parse(to_json(expected));
  json.update({{"ligands", true}, {"ions", false}, {"random_start", "none"}});
  EXPECT_EQ(nlohmann::json::parse(run.provenance.options_json), json);
  EXPECT_EQ(run.poses.poses.size(), 7U);
}

TEST_F(Dock, ThreadsNeverChangeTheResult) {
  std::set<std::string> runs, tables;
  for (const char* threads : {"1", "2", "4"}) {
    const std::string name = std::string("run") + threads + ".h5";
    const Outcome outcome = must(std::string("dock ") + kPair + "-o " + name +
                                 " --rotations 300 --random-start 5 --threads " + threads);
    EXPECT_EQ(outcome.error, "");
    runs.insert(datasets(read_run(path(name))));
    tables.insert(must("export " + name + " --format csv -o -").out);
  }
  EXPECT_EQ(runs.size(), 1U);
  EXPECT_EQ(tables.size(), 1U);
}

TEST_F(Dock, RandomStartIsUndoneInThePoses) {
  must(std::string("dock ") + kPair + "-o plain.h5 --rotations 60");
  must(std::string("dock ") + kPair + "-o run.h5 --rotations 900 --no-rescore --random-start 7");
  const mortise::Run plain = read_run(path("plain.h5")), run = read_run(path("run.h5"));
  EXPECT_EQ(run.provenance.seed, 7U);
  EXPECT_LT((plain.moving.knots.points - run.moving.knots.points).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_GT(rotation_angle(run.moving.search_from_input.rotation,
                           plain.moving.search_from_input.rotation),
            0.1);
  // The file's ligand sits right, so some leading pose is near the identity. Were poses left in
  // the moved frame, one of a hundred would be so near by chance once in hundreds of runs.
  const Eigen::Vector3d centre = run.moving.knots.points.topRows<3>().rowwise().mean();
  bool found = false;
  for (std::size_t i = 0; i < 100; ++i) {
    const RigidMotion& pose = run.poses.poses.at(i).moving_in_fixed;
    found = found || (rotation_angle(pose.rotation, Eigen::Quaterniond::Identity()) < 0.4 &&
                      (pose * centre - centre).norm() < 5.0);
  }
  EXPECT_TRUE(found);
}

TEST_F(Dock, CtrlCSavesAndResumeGivesTheSameBytes) {
  must(long_run("whole.h5"));
  const pid_t process = start(long_run("run.h5") + " --checkpoint 0.02");
  ASSERT_TRUE(wait_for("run.h5"));
  ::kill(process, SIGINT);
  const Outcome stopped = finish(process);
  ASSERT_EQ(stopped.code, 130) << stopped.error;
  EXPECT_THAT(stopped.error, HasSubstr("go on with: mortise dock -o run.h5 --resume"));

  const mortise::Run part = read_run(path("run.h5"));
  EXPECT_FALSE(part.complete);
  ASSERT_FALSE(part.candidates.empty());
  const auto done = std::accumulate(part.rotations.done.begin(), part.rotations.done.end(), 0);
  EXPECT_GT(done, 0);
  EXPECT_LT(done, 3600);
  EXPECT_GT(part.poses.poses.size(), 0U);
  must("export run.h5 --format csv");

  const nlohmann::json json = this->json("dock -o run.h5 --resume --threads 2");
  EXPECT_EQ(json["resumed"], true);
  const mortise::Run whole = read_run(path("whole.h5")), resumed = read_run(path("run.h5"));
  EXPECT_TRUE(resumed.complete);
  EXPECT_GT(resumed.seconds, part.seconds);
  EXPECT_EQ(datasets(resumed), datasets(whole));
  EXPECT_EQ(must("export run.h5 --format csv -o -").out,
            must("export whole.h5 --format csv -o -").out);
}

TEST_F(Dock, KillNineLosesNoMoreThanTheLastCheckpoint) {
  const std::string command = long_run("run.h5", 1800) + " --checkpoint 0.02";
  const pid_t process = start(command);
  ASSERT_TRUE(wait_for("run.h5"));
  ::kill(process, SIGKILL);
  ASSERT_EQ(finish(process).code, -1);
  EXPECT_FALSE(read_run(path("run.h5")).complete);
  must(command + " --resume");
  must(long_run("whole.h5", 1800));
  EXPECT_EQ(datasets(read_run(path("run.h5"))), datasets(read_run(path("whole.h5"))));
}

TEST_F(Dock, LibrarySearchStopsAndResumesToTheSamePoses) {
  const Molecule fixed = read_molecule({path("1hpv_receptor.pdb"), 0, {}}).molecule;
  const Molecule moving = read_molecule({path("1hpv_ligand.pdb"), 0, {}}).molecule;
  DockOptions options;
  options.rotations = 300;
  options.threads = 1;
  const SearchPlan plan = plan_dock(fixed, moving, options);
  RotationSearch whole = make_search(plan);
  EXPECT_TRUE(whole.run());
  RotationSearch first = make_search(plan);
  EXPECT_FALSE(first.run([](std::size_t, std::size_t) { return false; }));
  RotationSearch second = make_search(plan);
  second.resume(first.done(), first.candidates());
  EXPECT_TRUE(second.run());
  const PoseList a = rank_search(plan, whole), b = rank_search(plan, second);
  ASSERT_EQ(a.poses.size(), b.poses.size());
  for (std::size_t i = 0; i < a.poses.size(); ++i) {
    EXPECT_EQ(a.poses[i].score, b.poses[i].score);
    EXPECT_EQ(a.poses[i].moving_in_fixed.translation, b.poses[i].moving_in_fixed.translation);
  }
}

TEST_F(Dock, ResumeTakesOnlyWhatFits) {
  const pid_t process = start(long_run("run.h5") + " --checkpoint 0.02");
  ASSERT_TRUE(wait_for("run.h5"));
  ::kill(process, SIGTERM);
  ASSERT_EQ(finish(process).code, 130);
  expect_user_error("dock -o run.h5 --resume --spacing 3",
                    "spacing differs: the file was begun with 2.5, asked for now is 3");
  expect_user_error("dock 1hpv_receptor.pdb:A 1hpv_ligand.pdb -o run.h5 --resume",
                    "the run's fixed input is 1hpv_receptor.pdb, got 1hpv_receptor.pdb:A");
  expect_user_error("dock 1hpv_receptor.pdb 1hpv_receptor.pdb -o run.h5 --resume",
                    "the run's moving input has changed");
  fs::rename(scratch_ / "1hpv_ligand.pdb", scratch_ / "elsewhere.pdb");
  expect_user_error("dock -o run.h5 --resume", "the run's moving input is not there");
  must("dock 1hpv_receptor.pdb elsewhere.pdb -o run.h5 --resume");
  const std::string bytes = read_whole_file(path("run.h5"));
  EXPECT_THAT(must("dock -o run.h5 --resume").out, HasSubstr("run.h5 is complete already"));
  EXPECT_EQ(read_whole_file(path("run.h5")), bytes);
}

TEST_F(Dock, ReplacesAFileOnlyWhereTold) {
  const std::string command = std::string("dock ") + kPair + "--rotations 60 -o ";
  must(command + "run.h5 --resume");  // nothing there yet: starts
  expect_user_error(command + "run.h5",
                    "run.h5: exists already (--resume goes on with it, --force");
  must(command + "run.h5 --force");
  expect_user_error(command + "1hpv_ligand.pdb --force", "found an input");
  EXPECT_GT(fs::file_size(scratch_ / "1hpv_ligand.pdb"), 50000U);
  expect_user_error(command + "1hpv_complex.pdb --resume", "1hpv_complex.pdb: ");
}

TEST_F(Dock, NamesEachFaultInOneLine) {
  const std::string tail = " -o run.h5 --rotations 60";
  expect_user_error("dock none.pdb 1hpv_ligand.pdb" + tail, "none.pdb: ");
  expect_user_error("dock 1hpv_receptor.pdb:Z 1hpv_ligand.pdb" + tail, "Z");
  expect_user_error("dock 1hpv_receptor.pdb#0:A 1hpv_ligand.pdb" + tail, "#0");
  expect_user_error("dock 1hpv_receptor.pdb" + tail, "FIXED and MOVING, got one");
  expect_user_error("dock" + tail, "FIXED and MOVING, got none");
  expect_user_error(std::string("dock ") + kPair, "--output");
  expect_user_error(std::string("dock ") + kPair + "-o no/such/run.h5", "there is no directory");
  const std::string whole = std::string("dock ") + kPair + tail;
  expect_user_error(whole + " --preset slow",
                    "preset 'slow' is not one of fast, default, thorough");
  expect_user_error(whole + " --spacing nan", "spacing must be > 0");
  expect_user_error(whole + " --spacing wide", "--spacing");
  expect_user_error(whole + " --poses 0", "poses must be >= 1");
  expect_user_error(whole + " --spacing 0.001", "too fine");
  expect_user_error(whole + " --threads -1", "--threads");
  expect_user_error(whole + " --resume --force", "--force");
  EXPECT_FALSE(fs::exists(scratch_ / "run.h5"));
}

TEST_F(Dock, EveryCommandsHelpHasExamples) {
  for (const char* command : {"dock", "evaluate", "benchmark", "export", "info", "rotations"}) {
    const Outcome outcome = must(std::string(command) + " --help");
    EXPECT_THAT(outcome.out,
                AllOf(HasSubstr("Examples:"), HasSubstr(std::string("  mortise ") + command + " "),
                      HasSubstr("--threads"), HasSubstr("--json")))
        << command;
  }
  EXPECT_THAT(must("--help").out, HasSubstr("Exit codes: 0 done"));
  EXPECT_THAT(must("dock --help").out, HasSubstr("--rotations INT=3600"));
  expect_user_error("", "subcommand");
}

}  // namespace
}  // namespace mortise
