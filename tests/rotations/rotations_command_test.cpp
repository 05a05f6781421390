// SPDX-License-Identifier: GPL-3.0-or-later
// The rotations subcommand as a user meets it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

struct Outcome {
  int code = -1;
  std::string text;  // stdout and stderr
};

Outcome run(const std::string& arguments) {
  Outcome outcome;
  FILE* pipe =
      popen((std::string(MORTISE_PROGRAM) + " rotations " + arguments + " 2>&1").c_str(), "r");
  if (pipe == nullptr) return outcome;
  char block[4096];
  while (const std::size_t n = std::fread(block, 1, sizeof block, pipe))
    outcome.text.append(block, n);
  const int status = pclose(pipe);
  outcome.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return outcome;
}

TEST(RotationsCommand, PrintsCountMeanAndCoveringRadius) {
  const Outcome outcome = run("--count 1");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.text, HasSubstr("mean distance    126.47"));
  EXPECT_THAT(outcome.text, HasSubstr("covering radius  180.000 degrees"));
  EXPECT_THAT(run("--count 3600").text, HasSubstr("method           icosahedral"));
  EXPECT_EQ(run("--count 20 --quiet").text, "");
}

TEST(RotationsCommand, JsonIsOneObject) {
  const Outcome outcome = run("--count 576 --method hopf --json");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.text,
              StartsWith("{\"count\":576,\"method\":\"hopf\",\"mean_distance_degrees\":"));
  EXPECT_THAT(outcome.text, HasSubstr("\"covering_radius_degrees\":"));
  EXPECT_THAT(outcome.text, EndsWith("}\n"));
}

TEST(RotationsCommand, WritesTheQuaternions) {
  const auto path = std::filesystem::temp_directory_path() /
                    ("mortise_rotations_" + std::to_string(getpid()) + ".csv");
  EXPECT_EQ(run("--count 100 --quiet -o " + path.string()).code, 0);
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  EXPECT_EQ(line, "w,x,y,z");
  int rows = 0;
  for (; std::getline(file, line); ++rows) {
    double w = -1.0, x = 0.0, y = 0.0, z = 0.0;
    ASSERT_EQ(std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf", &w, &x, &y, &z), 4) << line;
    EXPECT_GE(w, 0.0);
    EXPECT_NEAR(w * w + x * x + y * y + z * z, 1.0, 1e-14);
  }
  EXPECT_EQ(rows, 100);
  std::filesystem::remove(path);
}

TEST(RotationsCommand, RefusesBadInputInOneLine) {
  for (const char* arguments :
       {"", "--count 0", "--count -5", "--count many", "--count 2.5", "--count 100000000000",
        "--count 99999999999999999999999", "--count 61 --method icosahedral",
        "--count 577 --method hopf", "--count 5 --method spiral", "--count 5 --threads -1",
        "--count 5 -o /nowhere/at/all.csv"}) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, 1) << arguments;
    EXPECT_THAT(outcome.text, StartsWith("mortise: error: ")) << arguments;
    EXPECT_EQ(outcome.text.find('\n'), outcome.text.size() - 1) << arguments << outcome.text;
  }
}

}  // namespace
