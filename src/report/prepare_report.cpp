// SPDX-License-Identifier: GPL-3.0-or-later
// The run as the report shows it: poses of a checkpoint, clusters, interfaces.
#include <algorithm>
#include <numeric>

#include "mortise/core/errors.hpp"
#include "mortise/report/interface_columns.hpp"
#include "mortise/report/write_report.hpp"
#include "mortise/search/candidate.hpp"

namespace mortise {
namespace {

constexpr std::size_t kProvisionalPoses = 2000;

// The best raw candidates of an unfinished search, in input frames.
PoseList provisional_poses(const Run& run) {
  std::vector<std::size_t> order(run.candidates.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const std::size_t count = std::min(kProvisionalPoses, order.size());
  const auto score = [&](std::size_t i) { return run.candidates[i].score; };
  std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count), order.end(),
                    [&](std::size_t a, std::size_t b) {
                      return score(a) != score(b) ? score(a) > score(b) : a < b;
                    });
  PoseList list;
  const CandidateFrames frames{run.rotations.quaternions, run.fixed.search_from_input,
                               run.moving.search_from_input};
  for (std::size_t k = 0; k < count; ++k) {
    const Candidate& c = run.candidates[order[k]];
    Pose pose;
    pose.moving_in_fixed = candidate_motion(c, frames);
    pose.moving_in_fixed.rotation = canonical(pose.moving_in_fixed.rotation);
    pose.score = c.score;
    pose.rotation_index = c.rotation_index;
    list.poses.push_back(pose);
  }
  return list;
}

}  // namespace

PreparedReport prepare_report(const Run& run, const ReportBodies& bodies,
                              const ReportOptions& options) {
  check_run(run, "report");
  if (options.structures < 0)
    throw InputError("report: structures must be >= 0, got " + std::to_string(options.structures));
  if (options.interfaces < 0)
    throw InputError("report: interfaces must be >= 0, got " + std::to_string(options.interfaces));
  if (options.pictures < 0)
    throw InputError("report: pictures must be >= 0, got " + std::to_string(options.pictures));
  if (options.part_triangles < 100)
    throw InputError("report: part_triangles must be >= 100, got " +
                     std::to_string(options.part_triangles));
  PreparedReport prepared = {run, {}};
  Run& shown = prepared.run;
  if (shown.poses.poses.empty() && !shown.complete) {
    shown.poses = provisional_poses(shown);
    shown.metrics.clear();
  }
  prepared.clusters = cluster_run(shown, bodies, options.clusters);
  if (shown.poses.poses.empty()) return prepared;
  const bool described =
      std::any_of(shown.metrics.begin(), shown.metrics.end(),
                  [](const MetricColumn& m) { return m.name == "interface_area"; });
  const bool molecules =
      !bodies.fixed.molecule.atoms.empty() && !bodies.moving.molecule.atoms.empty();
  if (options.interfaces > 0 && !described && molecules)
    set_metric_columns(
        shown, interface_columns(MolecularInterface(bodies.fixed.molecule, bodies.moving.molecule,
                                                    {.threads = options.threads}),
                                 shown.poses, static_cast<std::size_t>(options.interfaces),
                                 options.threads));
  return prepared;
}

}  // namespace mortise
