// SPDX-License-Identifier: GPL-3.0-or-later
// Stages of the ranking, one after the other.
#include "mortise/poses/stages.hpp"

#include <algorithm>
#include <chrono>
#include <numeric>

#include "mortise/core/errors.hpp"
#include "mortise/poses/cluster.hpp"

namespace mortise {
namespace {

std::vector<RigidMotion> motions_of(const std::vector<Pose>& poses) {
  std::vector<RigidMotion> motions;
  motions.reserve(poses.size());
  for (const Pose& pose : poses) motions.push_back(pose.moving_in_fixed);
  return motions;
}

void move(PoseList& list, const Stage& stage, int threads) {
  const std::vector<RigidMotion> moved = stage.move(motions_of(list.poses), threads);
  if (moved.size() != list.poses.size())
    throw InputError("stage " + stage.name + ": expected " + std::to_string(list.poses.size()) +
                     " poses back, got " + std::to_string(moved.size()));
  for (std::size_t i = 0; i < moved.size(); ++i) list.poses[i].moving_in_fixed = moved[i];
}

void score(PoseList& list, const Stage& stage, int threads) {
  const std::vector<std::string> names = stage.scorer->columns();
  const Eigen::MatrixXd columns = stage.scorer->score(motions_of(list.poses), threads);
  if (columns.rows() != static_cast<Eigen::Index>(names.size()) ||
      columns.cols() != static_cast<Eigen::Index>(list.poses.size()) || !columns.allFinite())
    throw InputError("stage " + stage.name + ": expected " + std::to_string(names.size()) +
                     " finite columns of " + std::to_string(list.poses.size()) +
                     " scores, got a table of " + std::to_string(columns.rows()) + " by " +
                     std::to_string(columns.cols()));
  if (stage.replaces) list.channel_names.clear();
  list.channel_names.insert(list.channel_names.end(), names.begin(), names.end());
  for (std::size_t i = 0; i < list.poses.size(); ++i) {
    Pose& pose = list.poses[i];
    if (stage.replaces) pose.channels.clear();
    const auto column = columns.col(static_cast<Eigen::Index>(i));
    pose.channels.insert(pose.channels.end(), column.begin(), column.end());
    pose.score = std::accumulate(pose.channels.begin(), pose.channels.end(), 0.0);
  }
}

void select(PoseList& list, const Stage& stage, const Eigen::Matrix3Xd& points) {
  // Equal scores in the order given, so that the ranking is one and the same everywhere.
  std::stable_sort(list.poses.begin(), list.poses.end(),
                   [](const Pose& a, const Pose& b) { return a.score > b.score; });
  const Clusters clusters = cluster_poses(
      motions_of(list.poses), points, {.radius = stage.cluster_radius, .max_clusters = stage.keep});
  for (std::size_t k = 0; k < clusters.founders.size(); ++k) {
    const std::size_t founder = clusters.founders[k];  // they rise: k is behind or there
    if (founder != k) list.poses[k] = std::move(list.poses[founder]);
    list.poses[k].cluster = static_cast<std::int32_t>(k);
  }
  list.poses.resize(clusters.founders.size());
}

}  // namespace

StagedPoses run_stages(PoseList poses, const std::vector<Stage>& stages,
                       const Eigen::Matrix3Xd& points, int threads) {
  StagedPoses result{std::move(poses), {}};
  for (const Stage& stage : stages) {
    const auto begin = std::chrono::steady_clock::now();
    if (stage.move) move(result.list, stage, threads);
    if (stage.scorer) score(result.list, stage, threads);
    select(result.list, stage, points);
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
    result.seconds.push_back(spent.count());
  }
  return result;
}

}  // namespace mortise
