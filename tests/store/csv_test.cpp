// SPDX-License-Identifier: GPL-3.0-or-later
// CSV lines: quotes, empty cells, line ends, and back.
#include "mortise/store/csv.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace {

using mortise::csv_cells;
using mortise::csv_field;
using ::testing::ElementsAre;

TEST(Csv, SplitsAtCommasOutsideQuotes) {
  EXPECT_THAT(csv_cells("a,b c,,1.5"), ElementsAre("a", "b c", "", "1.5"));
  EXPECT_THAT(csv_cells("\"a,b\",\"say \"\"yes\"\"\",\"\""), ElementsAre("a,b", "say \"yes\"", ""));
  EXPECT_THAT(csv_cells(""), ElementsAre(""));
  EXPECT_THAT(csv_cells(","), ElementsAre("", ""));
}

TEST(Csv, LineEndsAreNoPartOfTheLastCell) {
  EXPECT_THAT(csv_cells("a,b\r\n"), ElementsAre("a", "b"));
  EXPECT_THAT(csv_cells("a,\r"), ElementsAre("a", ""));
}

TEST(Csv, FieldsComeBack) {
  for (const char* text : {"", "plain", "a,b", "\"", "\"\"", "a \"b\", c", " spaces "})
    EXPECT_THAT(csv_cells(csv_field(text) + "," + csv_field("x")), ElementsAre(text, "x"));
  EXPECT_EQ(csv_field("plain"), "plain");
}

TEST(Csv, NumbersAreShortAndComeBack) {
  EXPECT_EQ(mortise::shortest(0.1), "0.1");
  EXPECT_EQ(std::stod(mortise::shortest(1.0 / 3.0)), 1.0 / 3.0);
  EXPECT_EQ(mortise::shortest(std::numeric_limits<double>::quiet_NaN()), "");
}

}  // namespace
