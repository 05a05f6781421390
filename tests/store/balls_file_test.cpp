// SPDX-License-Identifier: GPL-3.0-or-later
// Plain balls as text: what goes in comes out, and every bad line is an error that names it.
#include "mortise/store/balls_file.hpp"

#include <gmock/gmock.h>

#include "mortise/core/errors.hpp"
#include "mortise/store/atomic_file.hpp"
#include "mortise/store/knots_file.hpp"
#include "sample_run.hpp"

namespace mortise {
namespace {

using tests::ScratchDirectory;

std::string error_of(std::string_view text) {
  try {
    (void)parse_xyzr("b.xyzr", text);
  } catch (const FileError& e) {
    return e.what();
  }
  return "no error";
}

Knots three_balls() {
  Knots knots{Eigen::Matrix4Xd(4, 3), Eigen::VectorXcd::Ones(3)};
  knots.points.col(0) << 0.1, -2.0 / 3.0, 1e-300, 1.0 / 3.0;
  knots.points.col(1) << 1e20, 0.0, -0.0, 5e-324;
  knots.points.col(2) << -1.0, 2.0, 3.0, 4.0;
  return knots;
}

TEST(BallsFile, ReadsBallsWeightsCommentsBlanksAndCrLf) {
  const Knots knots = parse_xyzr("b.xyzr",
                                 "# a comment\r\n"
                                 "\r\n"
                                 "1 2 3 0.5\r\n"
                                 " \t-1.5e1\t+2 .25   1e-3  -2 # said behind\n"
                                 "   # alone\n"
                                 "\n"
                                 "7 8 9 10#close by");
  ASSERT_EQ(knots.size(), 3);
  EXPECT_EQ(knots.points.col(0), Eigen::Vector4d(1, 2, 3, 0.5));
  EXPECT_EQ(knots.points.col(1), Eigen::Vector4d(-15, 2, 0.25, 1e-3));
  EXPECT_EQ(knots.points.col(2), Eigen::Vector4d(7, 8, 9, 10));
  EXPECT_EQ(knots.weights[0], 1.0);
  EXPECT_EQ(knots.weights[1], -2.0);
  EXPECT_EQ(knots.weights[2], 1.0);
}

TEST(BallsFile, KeepsEveryNumberBitForBit) {
  Knots knots = three_balls();
  const Knots plain = parse_xyzr("b.xyzr", format_xyzr(knots));
  EXPECT_EQ(plain.points, knots.points);
  EXPECT_EQ(plain.weights, knots.weights);
  knots.weights[1] = 1.0 / 7.0;
  const Knots weighted = parse_xyzr("b.xyzr", format_xyzr(knots));
  EXPECT_EQ(weighted.points, knots.points);
  EXPECT_EQ(weighted.weights, knots.weights);
}

TEST(BallsFile, WritesWeightsOnlyWhereTheySaySomething) {
  Knots knots{Eigen::Vector4d(1, 2, 3, 0.5), Eigen::VectorXcd::Ones(1)};
  EXPECT_EQ(format_xyzr(knots),
            "# Mortise: balls of one body, in its own frame and length unit\n"
            "# x y z r\n1 2 3 0.5\n");
  knots.weights[0] = 2.0;
  EXPECT_THAT(format_xyzr(knots), ::testing::EndsWith("# x y z r weight\n1 2 3 0.5 2\n"));
}

TEST(BallsFile, NamesTheLineThatIsNoBall) {
  EXPECT_EQ(error_of("1 2 3 4\n\n1 2 3\n"),
            "b.xyzr:3: expected a ball, x y z r or x y z r weight, found 3 fields: '1 2 3'");
  EXPECT_EQ(error_of("1 2 3 4 5 6"),
            "b.xyzr:1: expected a ball, x y z r or x y z r weight, found 6 fields: '1 2 3 4 5 6'");
  EXPECT_EQ(error_of("# head\nATOM\n"),
            "b.xyzr:2: expected a ball, x y z r or x y z r weight, found 1 field: 'ATOM'");
  EXPECT_EQ(error_of("1 2 3 4\r\n1 two 3 4\r\n"),
            "b.xyzr:2: y: expected a finite number, found 'two'");
  EXPECT_EQ(error_of("1 2 3 4,5"), "b.xyzr:1: radius: expected a finite number, found '4,5'");
  EXPECT_EQ(error_of("1 2 nan 4"), "b.xyzr:1: z: expected a finite number, found 'nan'");
  EXPECT_EQ(error_of("inf 2 3 4"), "b.xyzr:1: x: expected a finite number, found 'inf'");
  EXPECT_EQ(error_of("1 2 3 1e999"), "b.xyzr:1: radius: expected a finite number, found '1e999'");
  EXPECT_EQ(error_of("1 2 3 4 +-5"), "b.xyzr:1: weight: expected a finite number, found '+-5'");
  EXPECT_EQ(error_of("1 2 3 0\n"), "b.xyzr:1: radius: expected a number > 0, found '0'");
  EXPECT_EQ(error_of("1 2 3 -1\n"), "b.xyzr:1: radius: expected a number > 0, found '-1'");
}

TEST(BallsFile, RefusesTextWithoutBallsAndBytesThatAreNoText) {
  EXPECT_EQ(error_of(""),
            "b.xyzr: expected at least one ball, x y z r or x y z r weight a line, found an empty "
            "file");
  EXPECT_EQ(error_of("# nothing\n\n"),
            "b.xyzr: expected at least one ball, x y z r or x y z r weight a line, found none");
  const std::string binary(
      "\x7f"
      "ELF\0\x01 \xff",
      8);
  EXPECT_EQ(error_of(binary),
            "b.xyzr:1: expected a ball, x y z r or x y z r weight, found 2 fields: '?ELF?? ?'");
  EXPECT_THAT(error_of(std::string(5000, 'x')), ::testing::EndsWith(std::string(40, 'x') + "...'"));
}

TEST(BallsFile, ReadsBothFormsByContent) {
  const ScratchDirectory scratch;
  Knots knots = three_balls();
  knots.weights[2] = 0.5;
  KnotsFile file;
  file.knots = knots;
  write_knots_file(scratch / "part.h5", file);
  write_xyzr(scratch / "part.XYZR", knots);
  write_xyzr(scratch / "other.txt", knots);
  for (const char* name : {"part.h5", "part.XYZR", "other.txt"}) {
    const Knots read = read_balls(scratch / name);
    EXPECT_EQ(read.points, knots.points) << name;
    EXPECT_EQ(read.weights, knots.weights) << name;
  }
  EXPECT_TRUE(is_balls_file(scratch / "part.h5"));
  EXPECT_TRUE(is_balls_file(scratch / "part.XYZR"));
  EXPECT_FALSE(is_balls_file(scratch / "other.txt"));
  EXPECT_THROW((void)read_balls(scratch / "absent.xyzr"), FileError);
  EXPECT_THROW((void)is_balls_file(scratch / "absent.xyzr"), FileError);
}

TEST(BallsFile, WritesRealWeightsOnly) {
  Knots knots = three_balls();
  knots.weights[0] = {1.0, 1e-9};
  EXPECT_THROW((void)format_xyzr(knots), InputError);
  EXPECT_THROW((void)format_xyzr({}), InputError);
}

}  // namespace
}  // namespace mortise
