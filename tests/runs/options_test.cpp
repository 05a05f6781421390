// SPDX-License-Identifier: GPL-3.0-or-later
// The tables of options: defaults and changes survive JSON, each range is checked, text sets them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "mortise/core/errors.hpp"
#include "mortise/runs/run_kind.hpp"

namespace mortise {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

template <class Options>
std::string error_of(const RunKind<Options>& kind, const Options& options) {
  try {
    (void)kind.plan(Body(), Body(), options);  // options are looked at first
  } catch (const InputError& e) {
    return e.what();
  }
  return "no error";
}

template <class Options>
void check_table(const RunKind<Options>& kind) {
  std::set<std::string> names;
  for (const OptionRow<Options>& row : kind.rows()) {
    SCOPED_TRACE(row.name);
    EXPECT_TRUE(names.insert(row.name).second) << "twice in the table";
    const bool number = std::holds_alternative<typename OptionRow<Options>::Real>(row.field) ||
                        std::holds_alternative<typename OptionRow<Options>::Integer>(row.field);
    if (!number) continue;
    // Just outside the range on either side, and no number at all, are refused by name.
    for (const double bad : {row.above_least ? row.least : row.least - 1.0, row.most + 1.0}) {
      if (!std::isfinite(bad)) continue;
      if (bad > 2e9 || bad < -2e9) continue;
      Options options;
      char text[40];
      std::snprintf(text, sizeof text, "%.0f", bad);
      set_option(options, row.name, text);
      EXPECT_THAT(error_of(kind, options), AllOf(HasSubstr(row.name), HasSubstr("must be")));
    }
    if (std::holds_alternative<typename OptionRow<Options>::Real>(row.field)) {
      Options options;
      set_option(options, row.name, "nan");
      EXPECT_THAT(error_of(kind, options), HasSubstr(row.name));
    }
  }
  for (const char* preset : {"fast", "default", "thorough"}) {
    const std::string json = kind.to_json(kind.preset(preset));
    EXPECT_EQ(kind.to_json(kind.parse(json)), json);
  }
  EXPECT_THROW((void)kind.preset("slow"), InputError);
  EXPECT_THROW((void)kind.parse("{}"), InputError);
  EXPECT_THROW((void)kind.parse("no JSON"), InputError);
}

TEST(OptionTable, OfDockingIsCheckedAndSurvivesJson) { check_table(dock_kind()); }
TEST(OptionTable, OfMatingIsCheckedAndSurvivesJson) { check_table(mate_kind()); }

TEST(OptionTable, TextSetsEveryKindOfOption) {
  DockOptions dock;
  set_option(dock, "spacing", "2.25");
  set_option(dock, "poses", "17");
  set_option(dock, "polish", "off");
  set_option(dock, "potential", "a file.txt");
  set_option(dock, "random_start", "9");
  EXPECT_EQ(dock.search.spacing, 2.25);
  EXPECT_EQ(dock.poses, 17);
  EXPECT_FALSE(dock.polish);
  EXPECT_EQ(dock.potential, "a file.txt");
  EXPECT_EQ(dock.random_start, 9U);
  const DockOptions back = parse_dock_options(to_json(dock));
  EXPECT_EQ(to_json(back), to_json(dock));
  EXPECT_EQ(back.random_start, 9U);
  MateOptions mate;
  set_option(mate, "axis", "0,0,1:0.5,-2,1e-3");
  ASSERT_TRUE(mate.axis.has_value());
  EXPECT_EQ(mate.axis->moving, Eigen::Vector3d(0.5, -2.0, 1e-3));
  EXPECT_EQ(parse_mate_options(to_json(mate)).axis->moving, mate.axis->moving);
}

TEST(OptionTable, TextThatIsNoValueIsRefused) {
  DockOptions dock;
  MateOptions mate;
  EXPECT_THROW(set_option(dock, "no_such_option", "1"), InputError);
  EXPECT_THROW(set_option(dock, "spacing", "wide"), InputError);
  EXPECT_THROW(set_option(dock, "spacing", "2x"), InputError);
  EXPECT_THROW(set_option(dock, "poses", "2.5"), InputError);
  EXPECT_THROW(set_option(dock, "polish", "maybe"), InputError);
  EXPECT_THROW(set_option(dock, "random_start", "-1"), InputError);
  EXPECT_THROW(set_option(mate, "axis", "0,0,1"), InputError);
}

TEST(OptionTable, SaysWhichOptionDiffers) {
  DockOptions one, two;
  two.search.spacing = 2.5;
  try {
    expect_same_options(to_json(one), to_json(two), "--resume");
    ADD_FAILURE();
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("--resume: spacing differs: the file was begun with 3.0, asked "
                                    "for now is 2.5"));
  }
  expect_same_options(to_json(one), to_json(one), "--resume");
}

}  // namespace
}  // namespace mortise
