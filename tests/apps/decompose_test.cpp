// SPDX-License-Identifier: GPL-3.0-or-later
// mortise decompose as a user runs it.
#include "mortise/parts/decompose.hpp"

#include <csignal>
#include <filesystem>
#include <fstream>

#include "apps/program.hpp"
#include "mortise/parts/format_part.hpp"
#include "mortise/parts/read_part.hpp"
#include "mortise/store/balls_file.hpp"
#include "mortise/store/knots_file.hpp"
#include "parts/shapes.hpp"

namespace mortise::testing {
namespace {

class Decompose : public Program {
 protected:
  Decompose() {
    write_file_atomically(path("torus.stl"), format_stl(shapes::torus(2.0, 0.7, 60, 30)));
    write_file_atomically(path("open.ply"),
                          format_ply(shapes::without_last(shapes::icosphere(1.0, 6), 240)));
    write_file_atomically(path("empty.stl"), "");
  }
  // Until the program, no longer the shell, has said what SIGINT and SIGTERM are to do.
  static bool wait_until_it_listens(pid_t process) {
    for (int i = 0; i < 30000; ++i) {
      std::ifstream status("/proc/" + std::to_string(process) + "/status");
      std::string line;
      bool ours = false;
      while (std::getline(status, line)) {
        ours = ours || line == "Name:\tmortise";
        if (!ours || line.rfind("SigCgt:", 0) != 0) continue;
        const unsigned long caught = std::stoul(line.substr(7), nullptr, 16);
        if ((caught >> (SIGINT - 1) & 1U) != 0 && (caught >> (SIGTERM - 1) & 1U) != 0) return true;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return false;
  }
};

TEST_F(Decompose, WritesPlainBallsWhereTheNameAsksForThem) {
  must("decompose torus.stl -o torus.h5 --grid 24 --weights share --quiet");
  must("decompose torus.stl -o torus.xyzr --grid 24 --weights share --quiet");
  const Knots stored = read_balls(path("torus.h5"));
  const Knots plain = read_balls(path("torus.xyzr"));
  EXPECT_EQ(plain.points, stored.points);
  EXPECT_EQ(plain.weights, stored.weights);
  EXPECT_THAT(read_whole_file(path("torus.xyzr")), ::testing::HasSubstr("# x y z r weight\n"));
}

TEST_F(Decompose, WritesBallsTreeAndFigures) {
  const nlohmann::json figures =
      json("decompose torus.stl -o torus.h5 --grid 32 --ply balls.ply --quiet");
  const double epsilon = figures["epsilon"];
  EXPECT_NEAR(epsilon, 0.5 * std::sqrt(3.0) * 5.4 / 32, 1e-6);
  EXPECT_LE(figures["hausdorff"], epsilon * (1 + 1e-5));
  EXPECT_GT(figures["hausdorff"], 0.3 * epsilon);
  EXPECT_LT(figures["n3"], figures["n1"]);
  EXPECT_EQ(figures["coverage"], 1.0);
  EXPECT_GT(figures["seconds"], 0.0);

  const KnotsFile file = read_knots_file(path("torus.h5"));
  EXPECT_EQ(file.knots.size(), figures["n3"].get<long>());
  ASSERT_TRUE(file.tree);
  EXPECT_EQ(file.tree->size(), figures["tree_balls"].get<long>());
  EXPECT_EQ(file.source_path, "torus.stl");
  EXPECT_THAT(file.provenance.command_line, ::testing::HasSubstr("--grid 32"));
  EXPECT_EQ(nlohmann::json::parse(file.provenance.options_json)["mu"], 0.25);
  EXPECT_EQ(
      read_part(path("balls.ply"), {.repair = {.find_self_intersections = false}}).mesh.size(),
      20 * 16 * file.knots.size());
  EXPECT_EQ(json("info torus.h5")["knots"]["count"], figures["n3"]);
}

TEST_F(Decompose, OptionsReachTheLibraryAndThreadsDoNotMatter) {
  const auto n3 = [&](const std::string& options) {
    return json("decompose torus.stl -o t.h5 --force --grid 24 --no-hausdorff --quiet " +
                options)["n3"]
        .get<long>();
  };
  const long cover = n3("");
  const long containment = n3("--reduction containment");
  EXPECT_LT(cover, containment);
  EXPECT_LT(containment, n3("--reduction none"));
  EXPECT_LT(cover, n3("--method octree"));
  EXPECT_LT(cover, n3("--method packing"));
  EXPECT_LT(n3("--reduction none --mu 1"), n3("--reduction none --mu 0.1"));
  EXPECT_EQ(n3("--weights share"), cover);
  EXPECT_LT(read_knots_file(path("t.h5")).knots.weights.real().maxCoeff(), 1.0);

  ::setenv("SOURCE_DATE_EPOCH", "0", 1);
  const auto knots = [&](const std::string& threads) {
    must("decompose torus.stl -o t.h5 --force --grid 24 --quiet --no-hausdorff --threads " +
         threads);
    return read_knots_file(path("t.h5")).knots.points;
  };
  EXPECT_EQ(knots("1"), knots("2"));
  ::unsetenv("SOURCE_DATE_EPOCH");
}

TEST_F(Decompose, OverwritesNoInputAndNoOlderAnswer) {
  const std::string torus = read_whole_file(path("torus.stl"));
  std::filesystem::create_symlink(path("torus.stl"), path("alias.stl"));
  for (const char* same : {"torus.stl", "./torus.stl", "alias.stl"}) {
    expect_user_error(std::string("decompose torus.stl --grid 8 --force -o ") + same, "an input");
    expect_user_error(std::string("decompose torus.stl --grid 8 --force -o t.h5 --ply ") + same,
                      "an input");
  }
  EXPECT_EQ(read_whole_file(path("torus.stl")), torus);
  expect_user_error("decompose torus.stl --grid 8 -o t.h5 --ply ./t.h5", "another file");
  EXPECT_FALSE(std::filesystem::exists(path("t.h5")));
  must("decompose torus.stl --grid 8 -o t.h5 --ply t.ply --quiet");
  const std::string older = read_whole_file(path("t.h5"));
  expect_user_error("decompose torus.stl --grid 9 -o t.h5", "--force replaces it");
  expect_user_error("decompose torus.stl --grid 9 -o u.h5 --ply t.ply", "--force replaces it");
  EXPECT_EQ(read_whole_file(path("t.h5")), older);
  must("decompose torus.stl --grid 9 -o t.h5 --ply t.ply --force --quiet");
  EXPECT_NE(read_whole_file(path("t.h5")), older);
}

TEST_F(Decompose, CtrlCEndsItAtOnceAndWritesNothing) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const pid_t process = start("decompose torus.stl -o t.h5 --grid 512");
    ASSERT_TRUE(wait_until_it_listens(process));
    const auto sent = std::chrono::steady_clock::now();
    ::kill(process, signal);
    const Outcome outcome = finish(process);
    EXPECT_EQ(outcome.code, 130) << outcome.out << outcome.error;
    EXPECT_THAT(outcome.error, ::testing::HasSubstr("mortise: interrupted: n"));
    EXPECT_LT(std::chrono::steady_clock::now() - sent, std::chrono::seconds(5));
    EXPECT_FALSE(std::filesystem::exists(path("t.h5")));
  }
}

TEST_F(Decompose, CountsTheBallsAddedAtTheBoundary) {
  // At two nodes a side one ball is left of those inside, and the ends need their own.
  write_file_atomically(path("rod.stl"), format_stl(shapes::cube(1.0)));
  for (const char* part : {"torus.stl", "rod.stl"})
    for (const int grid : {2, 3, 12}) {
      const std::string command = std::string("decompose ") + part + " -o t.h5 --force --grid " +
                                  std::to_string(grid) + " --no-hausdorff";
      const nlohmann::json figures = json(command);
      const long kept = figures["n3"].get<long>() - figures["n_boundary"].get<long>();
      EXPECT_LE(kept, figures["n1"].get<long>()) << command;
      EXPECT_GT(kept, 0) << command;
      EXPECT_THAT(must(command).out,
                  ::testing::HasSubstr(figures["n3"].dump() + ": " + std::to_string(kept) + " of " +
                                       figures["n1"].dump() + " inner ones and " +
                                       figures["n_boundary"].dump() + " added"));
    }
}

TEST_F(Decompose, SaysWhatIsAtFault) {
  expect_user_error("decompose none.stl -o t.h5", "none.stl");
  expect_user_error("decompose empty.stl -o t.h5", "empty.stl");
  expect_user_error("decompose open.ply -o t.h5", "open.ply");
  expect_user_error("decompose torus.stl -o t.h5 --grid 1", "--grid");
  expect_user_error("decompose torus.stl -o t.h5 --mu 2", "--mu");
  write_file_atomically(path("cube.stl"), format_stl(shapes::cube(1.0)));
  expect_user_error("decompose cube.stl -o t.h5 --grid 1024", "take one of 645 or less");
  expect_user_error("decompose torus.stl -o t.h5 --method spheres", "--method");
  expect_user_error("decompose torus.stl -o no/such/place/t.h5 --grid 8", "no/such/place");
  expect_user_error("decompose torus.stl", "--output");
  EXPECT_FALSE(std::filesystem::exists(path("t.h5")));
  EXPECT_THAT(must("decompose --help").out, ::testing::HasSubstr("mortise decompose part.stl -o"));
  const nlohmann::json open =
      json("decompose open.ply -o t.h5 --allow-open --grid 16 --quiet --no-hausdorff");
  EXPECT_GT(open["n3"], 0);
}

}  // namespace
}  // namespace mortise::testing
