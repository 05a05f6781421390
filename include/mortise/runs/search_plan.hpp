// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A run as data: what is searched and how candidates become poses. Docking and mating are two of
/// them.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "mortise/affinity/channel.hpp"
#include "mortise/core/knots.hpp"
#include "mortise/core/pose.hpp"
#include "mortise/core/progress.hpp"
#include "mortise/core/rigid_motion.hpp"
#include "mortise/poses/stages.hpp"
#include "mortise/rotations/rotation_set.hpp"
#include "mortise/search/rotation_search.hpp"
#include "mortise/store/run_file.hpp"

namespace mortise {

/// Where the search found a pose, before any stage moved it.
struct FoundPose {
  RigidMotion moving_in_fixed;
  double score = 0.0;    ///< of the search there, all channels
  int offset_index = 0;  ///< of SearchOptions::offsets
};

/// All that a run does between its two bodies and its poses. Frames: the moving body is taken in
/// the frame of the start, `start` applied to its input coordinates.
struct SearchPlan {
  std::string kind;        ///< "dock" or "mate"
  std::string options;     ///< JSON, for the run file
  BodyRecord fixed;        ///< with its knots, input frame
  BodyRecord moving;       ///< with its knots, frame of the start
  RigidMotion start = {};  ///< that the moving body is given first
  std::vector<Channel> channels;
  RotationSet rotations;  ///< into the search frame
  SearchOptions search;
  double search_weight = 1.0;           ///< what the search's score counts in the poses' score
  std::string search_column = "shape";  ///< its name among the poses' columns
  /// One list for each of search.offsets, whose candidates go through it by themselves; `stages`
  /// then take what all lists left. Empty = `stages` take all candidates.
  std::vector<std::vector<Stage>> offset_stages = {};
  /// What an offset is to people, such as "clearance": names figures by offset. Empty = none
  std::string offset_name = {};
  std::vector<Stage> stages;
  Eigen::Matrix3Xd points;  ///< 3 x N, of the moving body, frame of the start: RMSDs are over them
  /// Further columns of the final poses; may be empty. Motions are in input frames; `found` has one
  /// entry per pose.
  std::function<std::vector<MetricColumn>(const PoseList& poses,
                                          const std::vector<FoundPose>& found)>
      describe = {};
  std::vector<std::string> decisions = {};  ///< what was chosen otherwise than asked, for people
  int threads = 0;                          ///< 0 = all cores; never changes the result
};

/// Knots in the frame of a start, as the input frame has them.
[[nodiscard]] Knots input_knots(const Knots& knots, const RigidMotion& start);

/// The search that a plan asks for, ready to run.
[[nodiscard]] RotationSearch make_search(const SearchPlan& plan);

/// Ranked poses, and what the run file keeps of the ranking: seconds_rank_STAGE, wall time; of a
/// plan with offset_stages and offset_name also the figures of offset_scores().
struct RankedPoses {
  PoseList list;
  std::vector<Figure> figures;
};

/// Ranks candidates by the plan's stages. Motions are of the moving body in the frame of the start.
/// @throws InputError as run_stages(), or if a candidate's offset has no stages
[[nodiscard]] RankedPoses rank_candidates(const SearchPlan& plan,
                                          const std::vector<Candidate>& candidates,
                                          const CandidateFrames& frames);
/// The same of a search's candidates so far.
[[nodiscard]] PoseList rank_search(const SearchPlan& plan, const RotationSearch& search);

/// The best score that a run found at one of its offsets.
struct OffsetScore {
  double offset = 0.0;  ///< length unit of the bodies
  double best_score = 0.0;
};

/// The best score at each offset, by offset, as the figures "score_at_NAME_OFFSET" of a run have
/// them; offsets without a pose are left out. Empty unless the plan had an offset_name.
[[nodiscard]] std::vector<OffsetScore> offset_scores(const std::vector<Figure>& figures,
                                                     const std::string& offset_name);

/// The plan's further columns of a run's poses.
[[nodiscard]] std::vector<MetricColumn> plan_columns(const SearchPlan& plan, const Run& run);

/// What a run tells while it goes on; every member may be empty.
struct RunWatch {
  /// Once, when nothing is left to be refused, with the plan's decisions.
  std::function<void(const std::vector<std::string>& decisions)> prepared = {};
  ProgressCallback progress = {};  ///< of the search; false stops it, with what it has found so far
  double checkpoint_seconds = 30.0;                      ///< between two calls of save; >= 0
  std::function<void(const Run& unfinished)> save = {};  ///< without poses
  /// Once the search has ended or was stopped, before ranking: save() holds all of it.
  std::function<void(bool stopped)> ranking = {};
};

/// Runs a plan: search, ranking, description. run.seconds counts from the call, and goes on from
/// an earlier run's.
///
/// A run that `watch.progress` stopped is not complete; its poses are those found so far.
/// @param provenance  recorded as given, with the plan's options
/// @param earlier     an unfinished run of the same inputs and options to go on from
[[nodiscard]] Run run_plan(const SearchPlan& plan, const Provenance& provenance,
                           const RunWatch& watch = {}, const Run* earlier = nullptr);

}  // namespace mortise
