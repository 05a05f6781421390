// SPDX-License-Identifier: GPL-3.0-or-later
// Clearances searched at once: the true play of parts made with it, separate searches, ranking
// anew, options and errors.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "mortise/core/errors.hpp"
#include "mortise/core/rotation_vector.hpp"
#include "mortise/parts/mesh_solid.hpp"
#include "mortise/runs/run_kind.hpp"
#include "runs/boxy_part.hpp"
#include "scoring/contact_pair.hpp"

namespace mortise {
namespace {

using ::testing::HasSubstr;
using testing_parts::peg;
using testing_parts::peg_block;

constexpr double kPlay = 0.3;

// One axis, few turns: which clearance fits is the question here, not where the peg goes.
MateOptions quick(std::vector<double> clearances) {
  MateOptions options;
  options.knots = PartKnots::kBalls;
  options.clearances = std::move(clearances);
  options.axis = MateAxis{};
  options.rotations = 2;
  options.spacing = 0.03;
  options.skin = 0.045;
  options.ball_step = 0.03;
  options.distance_spacing = 0.02;
  options.samples = 800;
  options.polished = 8;
  options.poses = 10;
  options.check = 1;
  return options;
}

const MetricColumn& column(const mortise::Run& run, const std::string& name) {
  for (const MetricColumn& metric : run.metrics)
    if (metric.name == name) return metric;
  throw InputError("no column " + name);
}

std::string error_of(const MateOptions& options) {
  try {
    (void)plan_mate(peg_block(kPlay), peg(), options);
  } catch (const InputError& e) {
    return e.what();
  }
  return "no error";
}

TEST(ClearancesSlow, ThePlayOfAPegInItsHoleIsFound) {
  const mortise::Run tight = mate(peg_block(0.0), peg(), quick({0.0}));
  for (const double play : {0.15, 0.3}) {
    const mortise::Run run = mate(peg_block(play), peg(), quick({0.0, 0.15, 0.3, 0.45}));
    ASSERT_FALSE(run.poses.poses.empty());
    EXPECT_EQ(column(run, "clearance").values.front(), play);
    // The best is the column's and the figures' alike, and a mate with play scores as a tight one.
    const std::vector<OffsetScore> scores = offset_scores(run.figures, kClearance);
    ASSERT_EQ(scores.size(), 4U);
    const auto at = [&](double clearance) {
      return scores.at(static_cast<std::size_t>(std::lround(clearance / 0.15))).best_score;
    };
    EXPECT_EQ(at(play), run.poses.poses.front().score);
    EXPECT_NEAR(at(play), tight.poses.poses.front().score, 0.1 * at(play));
    EXPECT_LT(at(play + 0.15), 0.8 * at(play));  // too thick: it penetrates
    EXPECT_LT(at(0.0), 0.8 * at(play));          // too thin: it lies against two walls
    // The peg stands in the hole's middle, as far from its walls as from its floor.
    const Eigen::Vector3d foot =
        run.poses.poses.front().moving_in_fixed * Eigen::Vector3d(3.0, 3.0, 4.5);
    EXPECT_NEAR(foot[0], 9.0, 0.05);
    EXPECT_NEAR(foot[1], 8.0, 0.05);
    // Nothing overlaps, and the walls count as touched.
    EXPECT_LT(column(run, "penetration_volume").values.front(), 1e-6);
    EXPECT_GT(column(run, "contact_area").values.front(), 4 * 5 * 5);
  }
}

TEST(Clearances, ContactIsThatOfTheGrownBody) {
  const Part block = peg_block(kPlay), pin = peg();
  const auto body = [](const Part& part) {
    return ContactBody(sample_surface(part.mesh, 3000), DistanceField(*part.solid, 0.15, 2.0, 0),
                       part.solid->bounds().center());
  };
  const ContactPair pair(body(block), body(pin)), apart = pair.with_clearance(kPlay);
  RigidMotion seat;  // the peg in the hole's middle, as far from the floor as from the walls
  seat.translation << 6.0, 5.0, 4.0 + kPlay;
  // Four walls of 6 by 6 and the floor's 36 of the peg; the hole's are a little larger.
  EXPECT_NEAR(apart.fit(seat, 0.05, 1.0).contact, 180.0, 12.0);
  EXPECT_LT(apart.fit(seat, 0.05, 1.0).penetration, 0.1 * 180.0);
  EXPECT_LT(pair.fit(seat, 0.05, 1.0).contact, 1.0);  // 6 tolerances off
  // A gap of c at clearance c is what contact is at 0, however the body is turned.
  RigidMotion on_top;
  on_top.translation << 6.0, 5.0, 10.0 + kPlay;
  EXPECT_GT(apart.fit(on_top, 0.05, 1.0).contact, 0.0);
  EXPECT_EQ(pair.fit(on_top, 0.05, 1.0).contact, 0.0);
  // Descent takes the peg from against a wall to the middle.
  RigidMotion aside = seat;
  aside.translation[0] += 0.2;
  const RigidMotion back =
      apart.descend(apart.descend(aside, 0.2, 2.0, 1.0, 15), 0.05, 2.0, 1.0, 15);
  EXPECT_LT((back.translation - seat.translation).norm(), 0.02);
  // The gradient is of the energy with the clearance.
  const Eigen::Vector3d centre(9.0, 8.0, 8.0);
  const ContactEnergy here = apart.energy(aside, 0.2, 1.5, 1.0, centre, 3.0);
  for (int d = 0; d < 6; ++d) {
    const auto at = [&](double h) {
      Eigen::Matrix<double, 6, 1> twist = Eigen::Matrix<double, 6, 1>::Zero();
      twist[d] = h;
      const Eigen::Quaterniond q = rotation_from_vector(twist.tail<3>() / 3.0);
      return apart
          .energy(compose({q, centre - q * centre + twist.head<3>()}, aside), 0.2, 1.5, 1.0, centre,
                  3.0)
          .value;
    };
    // The interpolated distance has kinks at cell walls.
    EXPECT_NEAR(here.gradient[d], (at(3e-4) - at(-3e-4)) / 6e-4, 0.02 * here.gradient.norm()) << d;
  }
}

// Balls of one radius need no compression: then one search of many clearances and one of each are
// the same to the bit. The largest is in all of them, so that grids are the same.
TEST(ClearancesSlow, AreThoseOfSeparateSearches) {
  const auto balls = [](const Part& part) {
    std::vector<Eigen::Vector3d> inside;
    for (double x = 1.0; x < 20.0; x += 2.0)
      for (double y = 1.0; y < 20.0; y += 2.0)
        for (double z = 1.0; z < 20.0; z += 2.0)
          if (part.solid->signed_distance(Eigen::Vector3d(x, y, z), 1e9)[0] < 0.0)
            inside.emplace_back(x, y, z);
    Knots knots{Eigen::Matrix4Xd(4, static_cast<Eigen::Index>(inside.size())),
                Eigen::VectorXcd::Constant(static_cast<Eigen::Index>(inside.size()), 0.3)};
    for (std::size_t i = 0; i < inside.size(); ++i)
      knots.points.col(static_cast<Eigen::Index>(i)) << inside[i], 1.4;
    return Body(knots);
  };
  const Body fixed = balls(peg_block(1.0)), moving = balls(peg());
  MateOptions options = quick({0.0, 0.2, 0.4});
  options.rotations = 1;
  options.distance_spacing = 0.06;
  options.per_rotation = 4;
  options.polished = 4;
  options.check = 0;
  options.samples = 500;
  const mortise::Run all = mate(fixed, moving, options);
  const std::vector<OffsetScore> scores = offset_scores(all.figures, kClearance);
  ASSERT_EQ(scores.size(), 3U);
  for (const double clearance : {0.0, 0.2}) {
    options.clearances = {clearance, 0.4};
    const mortise::Run one = mate(fixed, moving, options);
    EXPECT_EQ(offset_scores(one.figures, kClearance).front().best_score,
              scores[clearance == 0.0 ? 0 : 1].best_score);
    std::size_t same = 0;
    for (const Candidate& c : one.candidates)
      for (const Candidate& d : all.candidates)
        same += c.offset_index == 0 && options.clearances[0] == 0.2 * d.offset_index &&
                        c.rotation_index == d.rotation_index && c.score == d.score &&
                        c.translation == d.translation
                    ? 1
                    : 0;
    EXPECT_EQ(same, 8U) << clearance;  // 2 ways round, 4 places each
  }
}

TEST(Clearances, ARunRankedAnewHasThemAndAnUnfinishedOneGoesOn) {
  const Body fixed = peg_block(kPlay), moving = peg();
  MateOptions options = quick({0.2, 0.3});
  options.polished = 5;
  options.check = 0;
  const SearchPlan plan = plan_mate(fixed, moving, options);
  const mortise::Run run = run_plan(plan, {});
  const mortise::Run again = rescore(run, plan);
  ASSERT_EQ(again.poses.poses.size(), run.poses.poses.size());
  EXPECT_EQ(again.poses.poses.front().score, run.poses.poses.front().score);
  EXPECT_EQ(column(again, "clearance").values, column(run, "clearance").values);
  EXPECT_EQ(offset_scores(again.figures, kClearance).size(), 2U);
  // Other options of ranking change the figures.
  options.tolerance = 0.01;
  const mortise::Run wider = rescore(run, plan_mate(fixed, moving, options));
  EXPECT_NE(offset_scores(wider.figures, kClearance)[0].best_score,
            offset_scores(run.figures, kClearance)[0].best_score);
  // Stopped after half of its rotations, and gone on with.
  mortise::Run half = run;
  half.complete = false;
  for (std::size_t r = 2; r < half.rotations.done.size(); ++r) half.rotations.done[r] = 0;
  std::erase_if(half.candidates, [](const Candidate& c) { return c.rotation_index >= 2; });
  const mortise::Run whole = run_plan(plan, {}, {}, &half);
  ASSERT_EQ(whole.poses.poses.size(), run.poses.poses.size());
  EXPECT_EQ(whole.poses.poses.front().score, run.poses.poses.front().score);
  EXPECT_EQ(column(whole, "clearance").values, column(run, "clearance").values);
  // A run without them has neither column nor figures.
  options.clearances = {};
  options.knots = PartKnots::kNodes;
  const mortise::Run plain = mate(fixed, moving, options);
  EXPECT_TRUE(offset_scores(plain.figures, kClearance).empty());
  EXPECT_THROW((void)column(plain, "clearance"), InputError);
}

TEST(Clearances, AreReadAsARangeOrAList) {
  const auto read = [](const std::string& text) {
    MateOptions options;
    set_option(options, "clearances", text);
    EXPECT_EQ(parse_mate_options(to_json(options)).clearances, options.clearances);
    return options.clearances;
  };
  EXPECT_EQ(read("0:0.1:0.3"), (std::vector<double>{0.0, 0.1, 0.2, 0.3}));
  EXPECT_EQ(read("0.05:0.1:0.3"), (std::vector<double>{0.05, 0.15, 0.25}));
  EXPECT_EQ(read("0.2:1:0.2"), std::vector<double>{0.2});
  EXPECT_EQ(read("0.3,0,0.1"), (std::vector<double>{0.0, 0.1, 0.3}));
  EXPECT_EQ(read("0.25"), std::vector<double>{0.25});
  EXPECT_EQ(read("none"), std::vector<double>{});
  EXPECT_EQ(read("0:1:49").size(), 50U);
  for (const char* bad : {"", "a", "0:0.1", "0:0:1", "0:-1:1", "1:0.1:0", "0:0.1:0.3:1", "0,,1",
                          "0,1,", "0,0.1,0.1", "-1,0", "nan", "0:0.1:inf", "0:1:50", "0 0.1"}) {
    MateOptions options;
    try {
      set_option(options, "clearances", bad);
      ADD_FAILURE() << bad << " was taken";
    } catch (const InputError& e) {
      EXPECT_THAT(e.what(), HasSubstr("clearances: expected MIN:STEP:MAX or a list")) << bad;
      EXPECT_THAT(e.what(), HasSubstr('"' + std::string(bad) + '"'));
    }
  }
}

TEST(Clearances, SayWhatIsWrong) {
  MateOptions options = quick({0.1});
  options.knots = PartKnots::kNodes;
  EXPECT_THAT(error_of(options), HasSubstr("clearances need --knots balls"));
  EXPECT_THAT(error_of(quick({-0.1})), HasSubstr(">= 0 and finite, got -0.1"));
  EXPECT_THAT(error_of(quick({0.0, std::nan("")})), HasSubstr("got nan"));
  EXPECT_THAT(error_of(quick({0.2, 0.1})), HasSubstr("must rise, got 0.1 after 0.2"));
  EXPECT_THAT(error_of(quick({0.0, 9.0})), HasSubstr("a quarter of the smaller part's diameter"));
  std::vector<double> many(51);
  for (std::size_t i = 0; i < many.size(); ++i) many[i] = 0.01 * static_cast<double>(i);
  EXPECT_THAT(error_of(quick(many)), HasSubstr("at most 50, got 51"));
}

}  // namespace
}  // namespace mortise
