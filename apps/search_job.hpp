// SPDX-License-Identifier: GPL-3.0-or-later
// One search from two prepared bodies to a run: checkpoints, resuming, ranking and the record of it
// all, for molecules and parts alike.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "mortise/core/progress.hpp"
#include "mortise/rotations/rotation_set.hpp"
#include "mortise/search/rotation_search.hpp"
#include "mortise/store/run_file.hpp"

namespace mortise::app {

/// A random rotation and a translation of up to `reach` per axis, the same for a seed everywhere.
[[nodiscard]] RigidMotion random_start(std::uint64_t seed, double reach);

struct SearchWatch {
  /// Called once, when nothing is left to be refused, with SearchJob::decisions; may be empty.
  std::function<void(const std::vector<std::string>& decisions)> prepared;
  /// Called once the search has ended or was stopped, before ranking: save() holds all of it.
  std::function<void(bool stopped)> ranking;  ///< may be empty
  ProgressCallback progress;
  double checkpoint_seconds = 30.0;                 ///< between two calls of save; >= 0
  std::function<void(const Run& unfinished)> save;  ///< without poses; empty = none
};

struct SearchFigures {
  std::array<int, 3> grid_size = {};
  double spacing = 0.0;
  double seconds_prepare = 0.0;  ///< knots, rotations, spectra of the fixed body
  double seconds_search = 0.0;
  double seconds_rank = 0.0;
  bool whole = false;  ///< the search ran from the first to the last rotation here
};

struct SearchResult {
  Run run;  ///< complete, or with a checkpoint and the poses so far
  SearchFigures figures;
  std::vector<std::string> decisions;  ///< SearchJob's
};

/// A search that is ready to run: what docking and mating have in common.
struct SearchJob {
  const char* kind;    ///< of the run: "dock" or "mate"
  BodyRecord fixed;    ///< without knots
  BodyRecord moving;   ///< without knots
  Knots fixed_knots;   ///< input frame
  Knots moving_knots;  ///< frame of the start
  RigidMotion start;   ///< that the moving body was given first
  const RotationSet* rotations;
  RotationSearch* search;
  std::function<PoseList()> rank;  ///< what the search has found, in the frame of the start
  std::chrono::steady_clock::time_point begin;  ///< of the preparations
  std::vector<std::string> decisions = {};  ///< what the preparations chose otherwise than asked
};

/// Runs the search and ranks. run.seconds and figures of time are left to the caller.
/// @param earlier  a checkpoint of the same inputs and settings to go on from
[[nodiscard]] SearchResult run_search(const SearchJob& job, const Provenance& provenance,
                                      const SearchWatch& watch, const Run* earlier = nullptr);

}  // namespace mortise::app
