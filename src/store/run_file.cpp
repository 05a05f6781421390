// SPDX-License-Identifier: GPL-3.0-or-later
// The run file: what lies where in it. The layout is described in docs/formats.md.
#include "mortise/store/run_file.hpp"

#include <algorithm>
#include <cmath>

#include "mortise/core/errors.hpp"
#include "mortise/store/atomic_file.hpp"
#include "store/records.hpp"

namespace mortise {
namespace {

using hdf5::Reader;
using hdf5::Shape;
using hdf5::Writer;

void expect_size(std::size_t found, std::size_t expected, const std::string& what) {
  if (found != expected)
    throw InputError(what + ": expected " + std::to_string(expected) + " entries, got " +
                     std::to_string(found));
}

void expect_rotation(std::int32_t index, Eigen::Index count, const std::string& what) {
  if (index < 0 || index >= count)
    throw InputError(what + ": rotation index " + std::to_string(index) + " is not one of " +
                     std::to_string(count) + " rotations");
}

void write_body(Writer& file, const std::string& group, const BodyRecord& body) {
  file.group(group);
  file.attribute(group, "path", body.path);
  file.attribute(group, "spec", body.spec);
  file.attribute(group, "sha256", body.sha256);
  file.attribute(group, "kind", body.kind);
  if (!body.unit.empty()) file.attribute(group, "unit", body.unit);
  hdf5::write_knots(file, group, body.knots);
  const Eigen::Quaterniond& q = body.search_from_input.rotation;
  const double rotation[4] = {q.w(), q.x(), q.y(), q.z()};
  file.array(group + "/search_rotation", {4}, rotation);
  file.array(group + "/search_translation", {3}, body.search_from_input.translation.data());
}

BodyRecord read_body(const Reader& file, const std::string& group) {
  BodyRecord body;
  body.path = file.text(group, "path");
  body.spec = file.text(group, "spec");
  body.sha256 = file.text(group, "sha256");
  body.kind = file.text(group, "kind");
  if (file.has_attribute(group, "unit")) body.unit = file.text(group, "unit");
  body.knots = hdf5::read_knots(file, group);
  const std::vector<double> q = file.reals(group + "/search_rotation", {4});
  const std::vector<double> t = file.reals(group + "/search_translation", {3});
  body.search_from_input = {Eigen::Quaterniond(q[0], q[1], q[2], q[3]),
                            Eigen::Vector3d(t[0], t[1], t[2])};
  return body;
}

void write_poses(Writer& file, const Run& run) {
  const std::vector<Pose>& poses = run.poses.poses;
  const hsize_t n = poses.size();
  std::vector<std::int32_t> rank, rotation_index, cluster, candidate;
  std::vector<double> score, quaternion, translation;
  for (const Pose& pose : poses) {
    rank.push_back(static_cast<std::int32_t>(rank.size()) + 1);
    rotation_index.push_back(pose.rotation_index);
    cluster.push_back(pose.cluster);
    candidate.push_back(pose.candidate);
    score.push_back(pose.score);
    const Eigen::Quaterniond& q = pose.moving_in_fixed.rotation;
    quaternion.insert(quaternion.end(), {q.w(), q.x(), q.y(), q.z()});
    const Eigen::Vector3d& t = pose.moving_in_fixed.translation;
    translation.insert(translation.end(), {t.x(), t.y(), t.z()});
  }
  file.group("/poses");
  file.array("/poses/rank", {n}, rank.data());
  file.array("/poses/score", {n}, score.data());
  file.group("/poses/channels");
  for (std::size_t c = 0; c < run.poses.channel_names.size(); ++c) {
    std::vector<double> column;
    column.reserve(poses.size());
    for (const Pose& pose : poses) column.push_back(pose.channels[c]);
    file.array("/poses/channels/" + run.poses.channel_names[c], {n}, column.data());
  }
  file.array("/poses/quaternion", {n, 4}, quaternion.data());
  file.array("/poses/translation", {n, 3}, translation.data());
  file.array("/poses/rotation_index", {n}, rotation_index.data());
  file.array("/poses/cluster", {n}, cluster.data());
  file.array("/poses/candidate", {n}, candidate.data());
  file.group("/poses/metrics");
  for (const MetricColumn& metric : run.metrics)
    file.array("/poses/metrics/" + metric.name, {n}, metric.values.data());
}

void read_poses(const Reader& file, Run& run) {
  const Shape shape = file.shape("/poses/score");
  const hsize_t n = shape.empty() ? 0 : shape[0];
  const std::vector<double> score = file.reals("/poses/score", {n});
  const std::vector<double> q = file.reals("/poses/quaternion", {n, 4});
  const std::vector<double> t = file.reals("/poses/translation", {n, 3});
  const std::vector<std::int32_t> rotation_index = file.integers("/poses/rotation_index", {n});
  const std::vector<std::int32_t> cluster = file.integers("/poses/cluster", {n});
  const std::vector<std::int32_t> candidate = file.integers("/poses/candidate", {n});
  std::vector<Pose>& poses = run.poses.poses;
  poses.resize(n);
  for (hsize_t i = 0; i < n; ++i) {
    poses[i].moving_in_fixed.rotation =
        Eigen::Quaterniond(q[4 * i], q[4 * i + 1], q[4 * i + 2], q[4 * i + 3]);
    poses[i].moving_in_fixed.translation = Eigen::Vector3d(t[3 * i], t[3 * i + 1], t[3 * i + 2]);
    poses[i].score = score[i];
    poses[i].rotation_index = rotation_index[i];
    poses[i].cluster = cluster[i];
    poses[i].candidate = candidate[i];
  }
  run.poses.channel_names = file.children("/poses/channels");
  for (const std::string& name : run.poses.channel_names) {
    const std::vector<double> column = file.reals("/poses/channels/" + name, {n});
    for (hsize_t i = 0; i < n; ++i) poses[i].channels.push_back(column[i]);
  }
  for (const std::string& name : file.children("/poses/metrics"))
    run.metrics.push_back({name, file.reals("/poses/metrics/" + name, {n})});
}

// Single precision, as the search has them: 16 bytes a candidate before compression.
void write_candidates(Writer& file, const std::vector<Candidate>& candidates) {
  const hsize_t n = candidates.size();
  std::vector<std::int32_t> rotation_index, offset_index;
  std::vector<float> score, translation;
  for (const Candidate& c : candidates) {
    rotation_index.push_back(c.rotation_index);
    offset_index.push_back(c.offset_index);
    score.push_back(c.score);
    translation.insert(translation.end(), c.translation.begin(), c.translation.end());
  }
  file.group("/candidates");
  file.array("/candidates/rotation_index", {n}, rotation_index.data());
  file.array("/candidates/offset_index", {n}, offset_index.data());
  file.array("/candidates/score", {n}, score.data());
  file.array("/candidates/translation", {n, 3}, translation.data());
}

std::vector<Candidate> read_candidates(const Reader& file) {
  const Shape shape = file.shape("/candidates/score");
  const hsize_t n = shape.empty() ? 0 : shape[0];
  const std::vector<float> score = file.floats("/candidates/score", {n});
  const std::vector<std::int32_t> rotation_index = file.integers("/candidates/rotation_index", {n});
  const std::vector<std::int32_t> offset_index = file.integers("/candidates/offset_index", {n});
  const std::vector<float> t = file.floats("/candidates/translation", {n, 3});
  std::vector<Candidate> result(n);
  for (hsize_t i = 0; i < n; ++i)
    result[i] = {
        rotation_index[i], score[i], {t[3 * i], t[3 * i + 1], t[3 * i + 2]}, offset_index[i]};
  return result;
}

void check_body(const BodyRecord& body, const std::string& where) {
  if (body.kind != "molecule" && body.kind != "part" && body.kind != "balls")
    throw InputError(where + " kind: expected molecule, part or balls, got \"" + body.kind + "\"");
  if (body.knots.size() > 0)
    check_knots(body.knots, (where + " knots").c_str());
  else
    expect_size(static_cast<std::size_t>(body.knots.weights.size()), 0, where + " weights");
}

}  // namespace

bool of_molecules(const Run& run) {
  return run.fixed.kind == "molecule" && run.moving.kind == "molecule";
}

void set_metric_columns(Run& run, std::vector<MetricColumn> columns) {
  for (MetricColumn& column : columns) {
    const auto old = std::find_if(run.metrics.begin(), run.metrics.end(),
                                  [&](const MetricColumn& c) { return c.name == column.name; });
    if (old != run.metrics.end())
      *old = std::move(column);
    else
      run.metrics.push_back(std::move(column));
  }
}

void check_run(const Run& run, const char* who) {
  const std::string where = std::string(who) + ": ";
  if (run.kind != "dock" && run.kind != "mate")
    throw InputError(where + "kind: expected dock or mate, got \"" + run.kind + "\"");
  check_body(run.fixed, where + "fixed");
  check_body(run.moving, where + "moving");
  const Eigen::Index rotations = run.rotations.quaternions.cols();
  expect_size(run.rotations.done.size(), static_cast<std::size_t>(rotations),
              where + "rotations done");
  std::vector<std::string> names;
  for (const Figure& figure : run.figures) names.push_back(figure.name);
  hdf5::check_names(names, where + "figures");
  hdf5::check_names(run.poses.channel_names, where + "channels");
  for (std::size_t i = 0; i < run.poses.poses.size(); ++i) {
    const Pose& pose = run.poses.poses[i];
    const std::string what = where + "pose " + std::to_string(i + 1);
    expect_size(pose.channels.size(), run.poses.channel_names.size(), what + " channels");
    if (pose.rotation_index != -1) expect_rotation(pose.rotation_index, rotations, what);
    if (pose.candidate < -1 || pose.candidate >= static_cast<std::int64_t>(run.candidates.size()))
      throw InputError(what + ": candidate " + std::to_string(pose.candidate) + " is not one of " +
                       std::to_string(run.candidates.size()));
    if (!std::isfinite(pose.score)) throw InputError(what + ": the score is not finite");
    if (!pose.moving_in_fixed.translation.allFinite() ||
        !(std::abs(pose.moving_in_fixed.rotation.norm() - 1.0) < 1e-6))
      throw InputError(what + ": expected a finite translation and a unit quaternion");
  }
  names.clear();
  for (const MetricColumn& metric : run.metrics) {
    names.push_back(metric.name);
    expect_size(metric.values.size(), run.poses.poses.size(), where + "metric " + metric.name);
  }
  hdf5::check_names(names, where + "metrics");
  for (std::size_t i = 0; i < run.candidates.size(); ++i) {
    const Candidate& c = run.candidates[i];
    const std::string what = where + "candidate " + std::to_string(i + 1);
    expect_rotation(c.rotation_index, rotations, what);
    if (run.rotations.done[static_cast<std::size_t>(c.rotation_index)] == 0)
      throw InputError(what + ": its rotation is not among those done");
    if (c.offset_index < 0)
      throw InputError(what + ": offset index " + std::to_string(c.offset_index) + " is below 0");
    if (!std::isfinite(c.score) || !std::all_of(c.translation.begin(), c.translation.end(),
                                                [](float x) { return std::isfinite(x); }))
      throw InputError(what + ": expected a finite score and translation");
  }
}

std::string serialize_run(const Run& run) {
  check_run(run, "write_run");
  Writer file;
  hdf5::write_head(file, "run", kRunFormatVersion, run.provenance);
  file.attribute("/", "kind", run.kind);
  file.attribute("/", "complete", std::int64_t{run.complete ? 1 : 0});
  file.attribute("/", "seconds", run.seconds);
  hdf5::write_figures(file, "/figures", run.figures);
  write_body(file, "/fixed", run.fixed);
  write_body(file, "/moving", run.moving);
  file.group("/rotations");
  const auto rotations = static_cast<hsize_t>(run.rotations.quaternions.cols());
  file.attribute("/rotations", "covering_radius", run.rotations.covering_radius);
  file.array("/rotations/quaternions", {rotations, 4}, run.rotations.quaternions.data());
  file.array("/rotations/done", {rotations}, run.rotations.done.data());
  write_poses(file, run);
  write_candidates(file, run.candidates);
  return file.bytes();
}

void write_run(const std::string& path, const Run& run) {
  write_file_atomically(path, serialize_run(run));
}

Run read_run(const std::string& path) {
  const Reader file(path);
  Run run;
  run.provenance = hdf5::read_head(file, "run", kRunFormatVersion);
  run.kind = file.text("/", "kind");
  run.complete = file.integer("/", "complete") != 0;
  run.seconds = file.real("/", "seconds");
  run.figures = hdf5::read_figures(file, "/figures");
  run.fixed = read_body(file, "/fixed");
  run.moving = read_body(file, "/moving");
  const Shape shape = file.shape("/rotations/quaternions");
  const hsize_t n = shape.empty() ? 0 : shape[0];
  const std::vector<double> q = file.reals("/rotations/quaternions", {n, 4});
  run.rotations.quaternions =
      Eigen::Map<const Eigen::Matrix4Xd>(q.data(), 4, static_cast<Eigen::Index>(n));
  run.rotations.done = file.bytes("/rotations/done", {n});
  run.rotations.covering_radius = file.real("/rotations", "covering_radius");
  read_poses(file, run);
  run.candidates = read_candidates(file);
  try {
    check_run(run, "contents");
  } catch (const InputError& e) {
    file.fail(e.what());
  }
  return run;
}

}  // namespace mortise
