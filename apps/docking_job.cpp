// SPDX-License-Identifier: GPL-3.0-or-later
// Reading, random start, search with checkpoints, ranking, and the record of it all.
#include "docking_job.hpp"

#include <chrono>
#include <cmath>
#include <numbers>
#include <random>

#include "mortise/core/errors.hpp"
#include "mortise/store/inputs.hpp"

namespace mortise::app {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

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

// The recorded model and chains, under another path. The recorded file itself may be gone, so its
// name is spared from being looked up.
MoleculeSpec recorded_spec(const BodyRecord& record, const std::string& path) {
  MoleculeSpec spec = record.spec.compare(0, record.path.size(), record.path) == 0
                          ? parse_molecule_spec("body.pdb" + record.spec.substr(record.path.size()))
                          : parse_molecule_spec(record.spec);
  spec.path = path;
  return spec;
}

DockBody read_body(const BodyRecord& record, const MoleculeSpec& spec,
                   const ReadMoleculeOptions& options) {
  ReadMoleculeResult read = read_molecule(spec, options);
  return {record, std::move(read.molecule), std::move(read.decisions)};
}

}  // namespace

DockBody read_dock_body(const std::string& text, const ReadMoleculeOptions& options) {
  const MoleculeSpec spec = parse_molecule_spec(text);
  BodyRecord record;
  record.path = spec.path;
  record.spec = text;
  DockBody body = read_body(record, spec, options);
  body.record.sha256 = sha256_of_file(spec.path);
  return body;
}

DockBody read_recorded_body(const BodyRecord& record, const Provenance& provenance,
                            const std::string& name, const std::string& text,
                            const ReadMoleculeOptions& options) {
  LocateOptions where;
  if (!text.empty()) {
    const MoleculeSpec given = parse_molecule_spec(text);
    const MoleculeSpec recorded = recorded_spec(record, given.path);
    if (given.model != recorded.model || given.chains != recorded.chains)
      throw InputError("--resume: the run's " + name + " input is " + record.spec + ", got " +
                       text);
    where.path = given.path;
  }
  BodyRecord bare = record;
  bare.knots = {};
  return read_body(bare, recorded_spec(record, locate_input(record, provenance, name, where)),
                   options);
}

RigidMotion random_start(std::uint64_t seed) {
  std::mt19937_64 generator(seed);  // its numbers are fixed by the standard, unlike distributions'
  const auto uniform = [&] { return static_cast<double>(generator() >> 11) * 0x1p-53; };
  // K. Shoemake, Uniform random rotations, Graphics Gems III (1992) 124-132.
  const double u = uniform();
  const double a = 2.0 * std::numbers::pi * uniform();
  const double b = 2.0 * std::numbers::pi * uniform();
  RigidMotion start;
  start.rotation = canonical({std::sqrt(u) * std::cos(b), std::sqrt(1.0 - u) * std::sin(a),
                              std::sqrt(1.0 - u) * std::cos(a), std::sqrt(u) * std::sin(b)});
  for (int d = 0; d < 3; ++d) start.translation[d] = 100.0 * uniform() - 50.0;
  return start;
}

DockResult dock(const DockBody& fixed, const DockBody& moving, const DockSettings& settings,
                const Provenance& provenance, const DockWatch& watch, const Run* earlier) {
  const auto begin = Clock::now();
  const RigidMotion start =
      settings.random_start ? random_start(*settings.random_start) : RigidMotion{};
  Molecule started = moving.molecule;
  for (Atom& atom : started.atoms) atom.position = start * atom.position;
  Docking docking(fixed.molecule, started, settings.options);
  RotationSearch& search = docking.search();

  DockResult result;
  result.figures.grid_size = search.grid_size();
  result.figures.spacing = search.spacing();
  result.figures.whole = earlier == nullptr;
  Run& run = result.run;
  run.kind = "dock";
  run.provenance = provenance;
  run.fixed = fixed.record;
  run.fixed.knots = docking.fixed_knots();
  run.fixed.search_from_input = search.search_from_fixed();
  run.moving = moving.record;
  run.moving.knots = docking.moving_knots();
  run.moving.knots.points.topRows<3>() =
      inverse(start) * Eigen::Matrix3Xd(run.moving.knots.points.topRows<3>());
  run.moving.search_from_input = compose(search.search_from_moving(), start);
  run.rotations = {docking.rotations().quaternions, docking.rotations().covering_radius, {}};
  if (earlier != nullptr && earlier->checkpoint)
    search.resume(earlier->rotations.done, candidates_of(*earlier->checkpoint));
  result.figures.seconds_prepare = seconds_since(begin);
  if (watch.prepared) watch.prepared();

  const auto record_progress = [&] {
    run.rotations.done = search.done();
    run.checkpoint = checkpoint_of(search.candidates());
  };
  for (bool stop = false; !run.complete && !stop;) {
    const auto leg = Clock::now();
    bool due = false;
    run.complete = search.run([&](std::size_t done, std::size_t total) {
      stop = watch.progress && !watch.progress(done, total);
      due = watch.save && seconds_since(leg) >= watch.checkpoint_seconds;
      return !stop && !due;
    });
    result.figures.seconds_search += seconds_since(leg);
    if (run.complete || stop) continue;
    record_progress();
    watch.save(run);
  }
  record_progress();
  if (run.complete) run.checkpoint.reset();

  const auto ranking = Clock::now();
  run.poses = docking.rank();
  for (Pose& pose : run.poses.poses) pose.moving_in_fixed = compose(pose.moving_in_fixed, start);
  result.figures.seconds_rank = seconds_since(ranking);
  return result;
}

}  // namespace mortise::app
