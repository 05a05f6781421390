// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes, and pictures where the programs that draw them are installed.
#include "mortise/report/pictures.hpp"

#include <gmock/gmock.h>

#include <filesystem>

#include "mortise/core/errors.hpp"
#include "mortise/store/atomic_file.hpp"
#include "report/run_program.hpp"
#include "sample_report.hpp"

namespace mortise::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

bool runs(const std::vector<std::string>& words) {
  try {
    detail::run_program(words, {}, "");
    return true;
  } catch (const InputError&) {
    return false;
  }
}

std::string message_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const InputError& e) {
    return e.what();
  }
  return "no error";
}

// Width and height in a PNG file's header; 0 if it is none.
std::pair<int, int> png_size(const std::string& path) {
  const std::string bytes = read_whole_file(path);
  if (bytes.compare(0, 8, "\x89PNG\r\n\x1a\n") != 0) return {};
  const auto number = [&](std::size_t at) {
    int value = 0;
    for (std::size_t i = at; i < at + 4; ++i)
      value = 256 * value + static_cast<unsigned char>(bytes[i]);
    return value;
  };
  return {number(16), number(20)};
}

TEST(RunProgram, SaysWhatFailedAndWhatToInstall) {
  detail::run_program({"true"}, {}, "");
  detail::run_program({"sh", "-c", "test \"$MORTISE_TEST\" = 'a b'"}, {"MORTISE_TEST=a b"}, "");
  EXPECT_THAT(message_of([] {
                detail::run_program({"sh", "-c", "echo it broke >&2; exit 3"}, {}, "a hint");
              }),
              ::testing::AllOf(HasSubstr("sh failed (a hint)"), HasSubstr("it broke")));
  EXPECT_THAT(message_of([] {
                detail::run_program({"mortise-no-such-program"}, {}, "Debian package nothing");
              }),
              HasSubstr("cannot run mortise-no-such-program"));
}

TEST(PovrayScene, HoldsBothBodiesAndACamera) {
  const ReportBodies bodies = protease();
  const std::string scene = povray_scene(bodies, {});
  EXPECT_THAT(scene, HasSubstr("camera {orthographic"));
  EXPECT_THAT(scene, HasSubstr("smooth_triangle"));
  EXPECT_THAT(scene, Not(HasSubstr("nan")));
  const std::string parts = povray_scene(plate_and_pin(), {});
  EXPECT_THAT(parts, HasSubstr("cylinder"));  // edges
  EXPECT_THAT(parts, HasSubstr("transmit 0.68"));
}

TEST(PovrayScene, RefusesEmptyBodiesAndSizes) {
  ReportBodies bodies = protease();
  EXPECT_THROW((void)povray_scene(bodies, {}, {.width = 15}), InputError);
  EXPECT_THROW((void)povray_scene(bodies, {}, {.height = 10'001}), InputError);
  bodies.moving.molecule.atoms.clear();
  EXPECT_THROW((void)povray_scene(bodies, {}), InputError);
}

TEST(Pictures, AreRenderedByPovray) {
  if (!runs({"povray", "--version"})) GTEST_SKIP() << "povray is not installed";
  const tests::ScratchDirectory scratch;
  const PictureOptions options = {.width = 64, .height = 48, .threads = 1};
  for (const ReportBodies& bodies : {protease(), plate_and_pin()}) {
    render_scene(povray_scene(bodies, {}, options), scratch / "pose.png", options);
    EXPECT_EQ(png_size(scratch / "pose.png"), std::make_pair(64, 48));
    // A blank picture packs into a few hundred bytes.
    EXPECT_GT(std::filesystem::file_size(scratch / "pose.png"), 1500u);
  }
  EXPECT_THAT(message_of([&] { render_scene("no scene {", scratch / "bad.png", options); }),
              HasSubstr("povray failed"));
  EXPECT_FALSE(std::filesystem::exists(scratch / "bad.png"));
}

class Plots : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!runs({"/usr/bin/python3", "-I", "-c", "import matplotlib"}))
      GTEST_SKIP() << "matplotlib is not installed";
  }
  tests::ScratchDirectory scratch_;
};

TEST_F(Plots, OfScoresAndWithMetricsOfTheFunnelAndTheBestOfTheFirst) {
  mortise::Run run = report_run(protease(), 60);
  run.metrics[0].values[3] = std::nan("");
  EXPECT_THAT(draw_plots(run, scratch_.path().string()),
              ElementsAre("scores.png", "funnel.png", "best_of_top.png"));
  EXPECT_GT(png_size(scratch_ / "funnel.png").first, 800);
  run.metrics = {{"placement_largest", std::vector<double>(60, 0.5)}};
  run.metrics[0].values[0] = 0.001;
  std::filesystem::create_directory(scratch_.path() / "parts");
  EXPECT_THAT(draw_plots(run, scratch_ / "parts"),
              ElementsAre("scores.png", "funnel.png", "best_of_top.png"));
  run.metrics.clear();
  std::filesystem::create_directory(scratch_.path() / "bare");
  EXPECT_THAT(draw_plots(run, scratch_ / "bare"), ElementsAre("scores.png"));
  run.poses.poses.clear();
  EXPECT_THAT(draw_plots(run, scratch_.path().string()), ::testing::IsEmpty());
}

TEST_F(Plots, OfSuccess) {
  draw_success({{"acceptable", {1, 3, std::nan(""), 700}}, {"medium", {1, 1, 1, 1}}}, 1000,
               scratch_ / "success.png");
  EXPECT_GT(png_size(scratch_ / "success.png").first, 800);
  EXPECT_THROW(draw_success({}, 10, scratch_ / "none.png"), InputError);
  EXPECT_THROW(draw_success({{"empty", {}}}, 10, scratch_ / "none.png"), InputError);
  EXPECT_THROW(draw_success({{"a", {1}}}, 0, scratch_ / "none.png"), InputError);
}

}  // namespace
}  // namespace mortise::testing
