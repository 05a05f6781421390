// SPDX-License-Identifier: GPL-3.0-or-later
// The rotations subcommand as a user meets it.
#include <gmock/gmock.h>

#include <cstdio>
#include <fstream>
#include <string>

#include "helpers/program.hpp"

namespace mortise {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class RotationsCommand : public tests::ProgramTest {
 protected:
  [[nodiscard]] std::string output(const std::string& arguments) const {
    return must("rotations " + arguments).out;
  }
};

TEST_F(RotationsCommand, PrintsCountMeanAndCoveringRadius) {
  const std::string one = output("--count 1");
  EXPECT_THAT(one, HasSubstr("mean distance    126.47"));
  EXPECT_THAT(one, HasSubstr("covering radius  180.000 degrees"));
  EXPECT_THAT(output("--count 3600"), HasSubstr("method           icosahedral"));
  EXPECT_EQ(output("--count 20 --quiet"), "");
}

TEST_F(RotationsCommand, JsonIsOneObject) {
  const std::string text = output("--count 576 --method hopf --json");
  EXPECT_THAT(text, StartsWith("{\"count\":576,\"method\":\"hopf\",\"mean_distance_degrees\":"));
  EXPECT_THAT(text, HasSubstr("\"covering_radius_degrees\":"));
  EXPECT_THAT(text, EndsWith("}\n"));
}

TEST_F(RotationsCommand, WritesTheQuaternions) {
  EXPECT_EQ(output("--count 100 --quiet -o rotations.csv"), "");
  std::ifstream file(path("rotations.csv"));
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
}

TEST_F(RotationsCommand, RefusesBadInputInOneLine) {
  for (const char* arguments :
       {"", "--count 0", "--count -5", "--count many", "--count 2.5", "--count 100000000000",
        "--count 99999999999999999999999", "--count 61 --method icosahedral",
        "--count 577 --method hopf", "--count 5 --method spiral", "--count 5 --threads -1",
        "--count 5 -o /nowhere/at/all.csv"})
    expect_user_error(std::string("rotations ") + arguments, "");
}

}  // namespace
}  // namespace mortise
