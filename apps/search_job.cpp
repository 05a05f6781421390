// SPDX-License-Identifier: GPL-3.0-or-later
// Random start, search with checkpoints, ranking, and the record of it all.
#include "search_job.hpp"

#include <cmath>
#include <numbers>
#include <random>
#include <utility>

#include "clock.hpp"

namespace mortise::app {
namespace {

Checkpoint checkpoint_of(const std::vector<Candidate>& candidates) {
  Checkpoint result;
  const auto n = static_cast<Eigen::Index>(candidates.size());
  result.translation.resize(3, n);
  result.channels.resize(0, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Candidate& c = candidates[static_cast<std::size_t>(i)];
    result.rotation_index.push_back(c.rotation_index);
    result.score.push_back(c.score);
    for (int d = 0; d < 3; ++d)
      result.translation(d, i) = c.translation[static_cast<std::size_t>(d)];
  }
  return result;
}

std::vector<Candidate> candidates_of(const Checkpoint& checkpoint) {
  std::vector<Candidate> result;
  for (std::size_t i = 0; i < checkpoint.score.size(); ++i) {
    const Eigen::Vector3f t =
        checkpoint.translation.col(static_cast<Eigen::Index>(i)).cast<float>();
    result.push_back({checkpoint.rotation_index[i],
                      static_cast<float>(checkpoint.score[i]),
                      {t[0], t[1], t[2]}});
  }
  return result;
}

}  // namespace

RigidMotion random_start(std::uint64_t seed, double reach) {
  std::mt19937_64 generator(seed);  // its numbers are fixed by the standard, unlike distributions'
  const auto uniform = [&] { return static_cast<double>(generator() >> 11) * 0x1p-53; };
  // K. Shoemake, Uniform random rotations, Graphics Gems III (1992) 124-132.
  const double u = uniform();
  const double a = 2.0 * std::numbers::pi * uniform();
  const double b = 2.0 * std::numbers::pi * uniform();
  RigidMotion start;
  start.rotation = canonical({std::sqrt(u) * std::cos(b), std::sqrt(1.0 - u) * std::sin(a),
                              std::sqrt(1.0 - u) * std::cos(a), std::sqrt(u) * std::sin(b)});
  for (int d = 0; d < 3; ++d) start.translation[d] = reach * (2.0 * uniform() - 1.0);
  return start;
}

SearchResult run_search(const SearchJob& job, const Provenance& provenance,
                        const SearchWatch& watch, const Run* earlier) {
  RotationSearch& search = *job.search;
  SearchResult result;
  result.figures.grid_size = search.grid_size();
  result.figures.spacing = search.spacing();
  result.figures.whole = earlier == nullptr;
  Run& run = result.run;
  run.kind = job.kind;
  run.provenance = provenance;
  run.fixed = job.fixed;
  run.fixed.knots = job.fixed_knots;
  run.fixed.search_from_input = search.search_from_fixed();
  run.moving = job.moving;
  run.moving.knots = job.moving_knots;
  run.moving.knots.points.topRows<3>() =
      inverse(job.start) * Eigen::Matrix3Xd(run.moving.knots.points.topRows<3>());
  run.moving.search_from_input = compose(search.search_from_moving(), job.start);
  run.rotations = {job.rotations->quaternions, job.rotations->covering_radius, {}};
  if (earlier != nullptr && earlier->checkpoint)
    search.resume(earlier->rotations.done, candidates_of(*earlier->checkpoint));
  result.figures.seconds_prepare = seconds_since(job.begin);
  result.decisions = job.decisions;
  if (watch.prepared) watch.prepared(job.decisions);

  const auto record_progress = [&] {
    run.rotations.done = search.done();
    run.checkpoint = checkpoint_of(search.candidates());
  };
  bool stop = false;
  while (!run.complete && !stop) {
    const auto leg = Clock::now();
    bool due = false;
    run.complete = search.run([&](std::size_t done, std::size_t total) {
      stop = watch.progress && !watch.progress(done, total);
      due = watch.save && seconds_since(leg) >= watch.checkpoint_seconds;
      return !stop && !due;
    });
    result.figures.seconds_search += seconds_since(leg);
    record_progress();
    if (!watch.save) continue;
    // Ranking may be cut short too: until then this is an unfinished run with all of the search.
    const bool searched = std::exchange(run.complete, false);
    watch.save(run);
    run.complete = searched;
  }
  if (run.complete) run.checkpoint.reset();

  if (watch.ranking) watch.ranking(stop);
  const auto ranking = Clock::now();
  run.poses = job.rank();
  for (Pose& pose : run.poses.poses)
    pose.moving_in_fixed = compose(pose.moving_in_fixed, job.start);
  result.figures.seconds_rank = seconds_since(ranking);
  return result;
}

}  // namespace mortise::app
