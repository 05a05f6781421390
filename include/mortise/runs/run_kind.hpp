// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Docking and mating as the two values of one type, and what can be done with a run of either.
#pragma once

#include <span>
#include <string>

#include "mortise/runs/dock.hpp"
#include "mortise/runs/mate.hpp"
#include "mortise/runs/option_row.hpp"
#include "mortise/runs/search_plan.hpp"
#include "mortise/store/body.hpp"
#include "mortise/store/run_file.hpp"

namespace mortise {

/// A kind of run: options and the plan that they make. A third kind would be one more of these.
template <class Options>
struct RunKind {
  const char* name;  ///< Run::kind
  Options (*preset)(const std::string& name);
  std::span<const OptionRow<Options>> (*rows)();
  std::string (*to_json)(const Options& options);
  Options (*parse)(const std::string& json);
  ReadBodyOptions (*reading)(const Options& options);
  SearchPlan (*plan)(const Body& fixed, const Body& moving, const Options& options);
};

[[nodiscard]] const RunKind<DockOptions>& dock_kind();
[[nodiscard]] const RunKind<MateOptions>& mate_kind();

/// Sets one option by its name from text, as the command line has it; on, off, true and false for
/// switches. @throws InputError if there is no such option or the text is not of its type
void set_option(DockOptions& options, const std::string& name, const std::string& text);
void set_option(MateOptions& options, const std::string& name, const std::string& text);

/// @throws InputError naming `who` and the first option in which two JSON objects differ
void expect_same_options(const std::string& recorded, const std::string& asked,
                         const std::string& who);

/// Where a run's inputs may be now.
struct InputPlaces {
  LocateOptions fixed, moving;
};

/// Reads an earlier run's bodies again and makes the plan of its kind.
/// @param options  in place of the run's own; JSON as to_json() gives it
/// @throws InputError as read_recorded_body() and the kind's plan, or if the run is of no known
/// kind
[[nodiscard]] SearchPlan plan_again(const Run& run, const std::string& options,
                                    const InputPlaces& places = {}, int threads = 0);

/// Ranks a run's candidates anew by a plan of it, without searching: other options of ranking,
/// another potential, stages of one's own. The result is complete where the run was; its metrics
/// are the plan's. Figure seconds_rank is new, those of the search stay.
/// @throws InputError if the run has no candidate or the plan searches otherwise than the run did
[[nodiscard]] Run rescore(const Run& run, const SearchPlan& plan);

}  // namespace mortise
