// SPDX-License-Identifier: GPL-3.0-or-later
// The course of a run: search with checkpoints, ranking, and the record of it all.
#include "mortise/runs/search_plan.hpp"

#include <chrono>

namespace mortise {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

}  // namespace

Knots input_knots(const Knots& knots, const RigidMotion& start) {
  Knots result = knots;
  result.points.topRows<3>() = inverse(start) * Eigen::Matrix3Xd(knots.points.topRows<3>());
  return result;
}

RotationSearch make_search(const SearchPlan& plan) {
  SearchOptions options = plan.search;
  options.threads = plan.threads;
  return {plan.channels, plan.rotations.quaternions, options};
}

StagedPoses rank_candidates(const SearchPlan& plan, const std::vector<Candidate>& candidates,
                            const CandidateFrames& frames) {
  PoseList list{{plan.search_column}, {}};
  list.poses.reserve(candidates.size());
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const Candidate& c = candidates[i];
    Pose pose;
    pose.candidate = static_cast<std::int32_t>(i);
    pose.moving_in_fixed = candidate_motion(c, frames);
    pose.score = plan.search_weight * c.score;
    pose.channels = {pose.score};
    pose.rotation_index = c.rotation_index;
    list.poses.push_back(std::move(pose));
  }
  return run_stages(std::move(list), plan.stages, plan.points, plan.threads);
}

PoseList rank_search(const SearchPlan& plan, const RotationSearch& search) {
  return rank_candidates(
             plan, search.candidates(),
             {plan.rotations.quaternions, search.search_from_fixed(), search.search_from_moving()})
      .list;
}

std::vector<MetricColumn> plan_columns(const SearchPlan& plan, const Run& run) {
  if (!plan.describe) return {};
  const CandidateFrames frames{run.rotations.quaternions, run.fixed.search_from_input,
                               run.moving.search_from_input};
  std::vector<FoundPose> found;
  for (const Pose& pose : run.poses.poses) {
    const Candidate& c = run.candidates.at(static_cast<std::size_t>(pose.candidate));
    found.push_back({candidate_motion(c, frames), c.score, c.offset_index});
  }
  return plan.describe(run.poses, found);
}

Run run_plan(const SearchPlan& plan, const Provenance& provenance, const RunWatch& watch,
             const Run* earlier) {
  const Clock::time_point begin = Clock::now();
  const double seconds_before = earlier != nullptr ? earlier->seconds : 0.0;
  RotationSearch search = make_search(plan);
  Run run;
  run.kind = plan.kind;
  run.provenance = provenance;
  run.provenance.options_json = plan.options;
  run.fixed = plan.fixed;
  run.fixed.search_from_input = search.search_from_fixed();
  run.moving = plan.moving;
  run.moving.knots = input_knots(plan.moving.knots, plan.start);
  run.moving.search_from_input = compose(search.search_from_moving(), plan.start);
  run.rotations = {plan.rotations.quaternions, plan.rotations.covering_radius, {}};
  if (earlier != nullptr) search.resume(earlier->rotations.done, earlier->candidates);
  const auto record_progress = [&] {
    run.rotations.done = search.done();
    run.candidates = search.candidates();
    run.seconds = seconds_before + seconds_since(begin);
  };
  const double seconds_prepare = seconds_since(begin);
  if (watch.prepared) watch.prepared(plan.decisions);

  const Clock::time_point searching = Clock::now();
  bool searched = false, stop = false;
  while (!searched && !stop) {
    const Clock::time_point leg = Clock::now();
    searched = search.run([&](std::size_t done, std::size_t total) {
      stop = watch.progress && !watch.progress(done, total);
      return !stop && !(watch.save && seconds_since(leg) >= watch.checkpoint_seconds);
    });
    record_progress();
    // Ranking may be cut short too: until then this is an unfinished run with all of the search.
    if (watch.save) watch.save(run);
  }
  const double seconds_search = seconds_since(searching);
  if (watch.ranking) watch.ranking(stop);

  const Clock::time_point ranking = Clock::now();
  StagedPoses staged = rank_candidates(
      plan, run.candidates,
      {plan.rotations.quaternions, search.search_from_fixed(), search.search_from_moving()});
  run.poses = std::move(staged.list);
  for (Pose& pose : run.poses.poses)
    pose.moving_in_fixed = compose(pose.moving_in_fixed, plan.start);
  const double seconds_rank = seconds_since(ranking);
  run.complete = searched;
  const auto figure = [&](const std::string& name, double value) {
    run.figures.push_back({name, value});
  };
  const auto [nx, ny, nz] = search.grid_size();
  figure("grid_x", nx);
  figure("grid_y", ny);
  figure("grid_z", nz);
  figure("grid_spacing", search.spacing());
  if (searched && earlier == nullptr) {
    figure("seconds_prepare", seconds_prepare);
    figure("seconds_search", seconds_search);
    figure("seconds_rank", seconds_rank);
    for (std::size_t i = 0; i < staged.seconds.size(); ++i)
      figure("seconds_rank_" + plan.stages[i].name, staged.seconds[i]);
  }
  if (searched && plan.describe) {
    const Clock::time_point describing = Clock::now();
    run.metrics = plan_columns(plan, run);
    if (earlier == nullptr) figure("seconds_describe", seconds_since(describing));
  }
  run.seconds = seconds_before + seconds_since(begin);
  return run;
}

}  // namespace mortise
