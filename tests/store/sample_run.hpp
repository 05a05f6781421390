// SPDX-License-Identifier: GPL-3.0-or-later
// A small run made by hand.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <random>
#include <string>

#include "helpers/random_motions.hpp"
#include "helpers/scratch_directory.hpp"
#include "mortise/store/run_file.hpp"

namespace mortise::testing {

inline Knots sample_knots(int count, std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(0.5, 30.0);
  Knots knots;
  knots.points.resize(4, count);
  knots.weights.resize(count);
  for (int i = 0; i < count; ++i) {
    for (int k = 0; k < 4; ++k) knots.points(k, i) = uniform(random);
    knots.weights(i) = {uniform(random), -uniform(random)};
  }
  return knots;
}

/// A dock run of `pose_count` poses with every field away from its default.
inline Run sample_run(int pose_count = 5, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-60.0, 60.0);
  Run run;
  run.provenance = {"0.1.0", "mortise dock a.pdb b.pdb", "/somewhere", R"({"spacing": 2.0})",
                    7,       "2026-01-31T12:00:00Z",     "bench"};
  run.complete = true;
  run.seconds = 12.5;
  run.figures = {{"seconds_search", 1.07}, {"best_score", 321.0}, {"a_third", -1e-300}};
  run.fixed = {"a.pdb",
               "a.pdb:A",
               std::string(64, 'a'),
               sample_knots(40, random),
               {tests::random_rotation(random), Eigen::Vector3d(1, 2, 3)},
               "angstrom",
               "molecule"};
  run.moving = {"b.pdb",
                "b.pdb",
                std::string(64, 'b'),
                sample_knots(30, random),
                {tests::random_rotation(random), Eigen::Vector3d(-4, 5, 6)},
                "angstrom",
                "molecule"};
  run.rotations.covering_radius = 0.22;
  run.rotations.quaternions.resize(4, 50);
  run.rotations.done.assign(50, 1);
  run.rotations.done[3] = 0;
  for (int i = 0; i < 50; ++i) {
    const Eigen::Quaterniond q = tests::random_rotation(random);
    run.rotations.quaternions.col(i) = Eigen::Vector4d(q.w(), q.x(), q.y(), q.z());
  }
  run.poses.channel_names = {"shape", "electrostatics"};
  run.metrics = {{"interface_rmsd", {}}, {"fnat", {}}};
  for (int i = 0; i < pose_count; ++i) {
    Pose pose;
    pose.moving_in_fixed = {tests::random_rotation(random),
                            Eigen::Vector3d(uniform(random), uniform(random), uniform(random))};
    pose.score = 1000.0 / (i + 1);
    pose.channels = {pose.score - 0.1, 0.1};
    pose.rotation_index = (7 * i) % 50;
    pose.cluster = i / 2;
    run.poses.poses.push_back(pose);
    run.metrics[0].values.push_back(0.1 * i);
    run.metrics[1].values.push_back(i == 1 ? std::numeric_limits<double>::quiet_NaN()
                                           : 1.0 / (i + 1));
  }
  return run;
}

/// Candidates of the rotations that sample_run() has done; their scores fall.
inline std::vector<Candidate> sample_candidates(int count) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> uniform(-1.0F, 1.0F);
  std::vector<Candidate> candidates;
  for (int i = 0; i < count; ++i)
    candidates.push_back({i % 46 + 4,
                          100.0F / static_cast<float>(i + 3),
                          {uniform(random), uniform(random), uniform(random)},
                          i % 3});
  return candidates;
}

}  // namespace mortise::testing
