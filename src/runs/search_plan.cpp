// SPDX-License-Identifier: GPL-3.0-or-later
// The course of a run: search with checkpoints, ranking, and the record of it all.
#include "mortise/runs/search_plan.hpp"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <iterator>
#include <utility>

#include "mortise/core/errors.hpp"
#include "runs/option_table.hpp"

namespace mortise {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

std::string score_figure(const std::string& offset_name) { return "score_at_" + offset_name + '_'; }

// Poses of the candidates that `is_taken` takes, as the search left them.
template <class IsTaken>
PoseList searched_poses(const SearchPlan& plan, const std::vector<Candidate>& candidates,
                        const CandidateFrames& frames, const IsTaken& is_taken) {
  PoseList list{{plan.search_column}, {}};
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const Candidate& c = candidates[i];
    if (!is_taken(c)) continue;
    Pose pose;
    pose.candidate = static_cast<std::int32_t>(i);
    pose.moving_in_fixed = candidate_motion(c, frames);
    pose.score = plan.search_weight * c.score;
    pose.channels = {pose.score};
    pose.rotation_index = c.rotation_index;
    list.poses.push_back(std::move(pose));
  }
  return list;
}

void add_seconds(std::vector<Figure>& figures, const std::vector<Stage>& stages,
                 const std::vector<double>& seconds) {
  for (std::size_t i = 0; i < stages.size(); ++i) {
    const std::string name = "seconds_rank_" + stages[i].name;
    const auto same = std::find_if(figures.begin(), figures.end(),
                                   [&](const Figure& figure) { return figure.name == name; });
    if (same == figures.end())
      figures.push_back({name, seconds[i]});
    else
      same->value += seconds[i];
  }
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

RankedPoses rank_candidates(const SearchPlan& plan, const std::vector<Candidate>& candidates,
                            const CandidateFrames& frames) {
  RankedPoses result;
  PoseList list;
  if (plan.offset_stages.empty())
    list = searched_poses(plan, candidates, frames, [](const Candidate&) { return true; });
  for (const Candidate& c : candidates)
    if (!plan.offset_stages.empty() &&
        !(c.offset_index >= 0 &&
          static_cast<std::size_t>(c.offset_index) < plan.offset_stages.size()))
      throw InputError("ranking: expected candidates of " +
                       std::to_string(plan.offset_stages.size()) + " offsets, found one of index " +
                       std::to_string(c.offset_index));
  for (std::size_t o = 0; o < plan.offset_stages.size(); ++o) {
    StagedPoses staged = run_stages(
        searched_poses(
            plan, candidates, frames,
            [&](const Candidate& c) { return static_cast<std::size_t>(c.offset_index) == o; }),
        plan.offset_stages[o], plan.points, plan.threads);
    add_seconds(result.figures, plan.offset_stages[o], staged.seconds);
    list.channel_names = staged.list.channel_names;
    if (staged.list.poses.empty()) continue;
    if (!plan.offset_name.empty())
      result.figures.push_back(
          {score_figure(plan.offset_name) + short_number(plan.search.offsets.at(o)),
           staged.list.poses.front().score});
    std::move(staged.list.poses.begin(), staged.list.poses.end(), std::back_inserter(list.poses));
  }
  StagedPoses staged = run_stages(std::move(list), plan.stages, plan.points, plan.threads);
  add_seconds(result.figures, plan.stages, staged.seconds);
  result.list = std::move(staged.list);
  return result;
}

std::vector<OffsetScore> offset_scores(const std::vector<Figure>& figures,
                                       const std::string& offset_name) {
  std::vector<OffsetScore> scores;
  const std::string start = score_figure(offset_name);
  for (const Figure& figure : figures) {
    if (!figure.name.starts_with(start)) continue;
    OffsetScore score{0.0, figure.value};
    const char* const end = figure.name.data() + figure.name.size();
    if (std::from_chars(figure.name.data() + start.size(), end, score.offset).ptr == end)
      scores.push_back(score);
  }
  std::sort(scores.begin(), scores.end(),
            [](const OffsetScore& a, const OffsetScore& b) { return a.offset < b.offset; });
  return scores;
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
  RankedPoses ranked = rank_candidates(
      plan, run.candidates,
      {plan.rotations.quaternions, search.search_from_fixed(), search.search_from_moving()});
  run.poses = std::move(ranked.list);
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
  }
  for (Figure& f : ranked.figures)
    if (!f.name.starts_with("seconds") || (searched && earlier == nullptr))
      run.figures.push_back(std::move(f));
  if (searched && plan.describe) {
    const Clock::time_point describing = Clock::now();
    run.metrics = plan_columns(plan, run);
    if (earlier == nullptr) figure("seconds_describe", seconds_since(describing));
  }
  run.seconds = seconds_before + seconds_since(begin);
  return run;
}

}  // namespace mortise
