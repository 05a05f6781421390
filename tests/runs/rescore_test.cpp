// SPDX-License-Identifier: GPL-3.0-or-later
// Runs ranked anew: the same options give the same poses, other options those of a run with them.
#include <gtest/gtest.h>

#include <numeric>

#include "mortise/core/errors.hpp"
#include "mortise/runs/run_kind.hpp"
#include "runs/voxel_parts.hpp"

namespace mortise {
namespace {

const std::string kFixed = MORTISE_SOURCE_DIR "/molecules/1hpv_receptor.pdb";
const std::string kMoving = MORTISE_SOURCE_DIR "/molecules/1hpv_ligand.pdb";

DockOptions quick_docking() {
  DockOptions options;
  options.rotations = 60;
  options.poses = 40;
  options.random_start = 5;
  return options;
}

void expect_same_poses(const PoseList& a, const PoseList& b) {
  EXPECT_EQ(a.channel_names, b.channel_names);
  ASSERT_EQ(a.poses.size(), b.poses.size());
  for (std::size_t i = 0; i < a.poses.size(); ++i) {
    // Where the start turns the body, a candidate's frame is composed anew: the last bits differ.
    EXPECT_NEAR(a.poses[i].score, b.poses[i].score, 1e-6 * std::abs(b.poses[i].score)) << i;
    EXPECT_LT(
        (a.poses[i].moving_in_fixed.translation - b.poses[i].moving_in_fixed.translation).norm(),
        1e-5)
        << i;
    EXPECT_EQ(a.poses[i].rotation_index, b.poses[i].rotation_index) << i;
  }
}

TEST(Rescore, TheSameOptionsGiveTheSamePosesAndOthersThoseOfTheirOwnRun) {
  const Body fixed = read_body(kFixed), moving = read_body(kMoving);
  const DockOptions options = quick_docking();
  const mortise::Run run = dock(fixed, moving, options);
  ASSERT_TRUE(run.complete);
  ASSERT_EQ(run.candidates.size(), 240U);
  expect_same_poses(rescore(run, plan_again(run, to_json(options))).poses, run.poses);
  DockOptions other = options;
  other.rescore = false;
  other.polish = false;
  other.cluster_radius = 5.0;
  const mortise::Run again = rescore(run, plan_again(run, to_json(other)));
  expect_same_poses(again.poses, dock(fixed, moving, other).poses);
  EXPECT_EQ(again.poses.channel_names, std::vector<std::string>{"shape"});
  EXPECT_EQ(again.provenance.options_json, to_json(other));
  EXPECT_EQ(again.candidates.size(), run.candidates.size());
}

TEST(Rescore, TakesStagesOfOnesOwn) {
  // A score that likes poses whose translation along x is small.
  class NearX : public PoseScorer {
   public:
    [[nodiscard]] std::vector<std::string> columns() const override { return {"near_x"}; }
    [[nodiscard]] Eigen::MatrixXd score(const std::vector<RigidMotion>& poses, int) const override {
      Eigen::MatrixXd result(1, static_cast<Eigen::Index>(poses.size()));
      for (std::size_t i = 0; i < poses.size(); ++i)
        result(0, static_cast<Eigen::Index>(i)) = -std::abs(poses[i].translation.x());
      return result;
    }
  };
  DockOptions options = quick_docking();
  options.random_start.reset();
  options.polish = false;
  const mortise::Run run = dock(read_body(kFixed), read_body(kMoving), options);
  SearchPlan plan = plan_again(run, to_json(options));
  plan.stages = {{.name = "near_x",
                  .scorer = std::make_shared<NearX>(),
                  .replaces = true,
                  .keep = 7,
                  .cluster_radius = 1.0}};
  const PoseList list = rescore(run, plan).poses;
  ASSERT_EQ(list.poses.size(), 7U);
  EXPECT_EQ(list.channel_names, std::vector<std::string>{"near_x"});
  double least = std::numeric_limits<double>::infinity();
  const CandidateFrames frames{run.rotations.quaternions, run.fixed.search_from_input,
                               run.moving.search_from_input};
  for (const Candidate& c : run.candidates)
    least = std::min(least, std::abs(candidate_motion(c, frames).translation.x()));
  EXPECT_NEAR(-list.poses.front().score, least, 1e-9);
}

TEST(Rescore, RefusesWhatWasNotSearched) {
  DockOptions options = quick_docking();
  mortise::Run run = dock(read_body(kFixed), read_body(kMoving), options);
  DockOptions other = options;
  other.rotations = 120;
  EXPECT_THROW((void)rescore(run, plan_again(run, to_json(other))), InputError);
  run.candidates.clear();
  EXPECT_THROW((void)rescore(run, plan_again(run, to_json(options))), InputError);
  run.kind = "glue";
  EXPECT_THROW((void)plan_again(run, to_json(options)), InputError);
}

TEST(Rescore, OfPartsJudgesContactByOtherWeights) {
  MateOptions options;
  options.rotations = 60;
  options.spacing = 0.05;
  options.skin = 0.06;
  options.distance_spacing = 0.03;
  options.samples = 500;
  options.polished = 30;
  options.poses = 5;
  options.check = 1;
  const Body fixed = testing_parts::mortise_block(), moving = testing_parts::tenon_plate();
  const SearchPlan plan = plan_mate(fixed, moving, options);
  const mortise::Run run = run_plan(plan, make_provenance("test", plan.options));
  expect_same_poses(rescore(run, plan).poses, run.poses);
  EXPECT_EQ(run.metrics.front().name, "contact_area");
  options.penetration_weight = 30.0;
  const mortise::Run strict = rescore(run, plan_mate(fixed, moving, options));
  EXPECT_LE(strict.poses.poses.front().score, run.poses.poses.front().score + 1e-9);
}

}  // namespace
}  // namespace mortise
