// SPDX-License-Identifier: GPL-3.0-or-later
// One mating from two part files to a run.
#pragma once

#include <string>
#include <vector>

#include "mate_options.hpp"
#include "mortise/store/run_file.hpp"
#include "search_job.hpp"

namespace mortise::app {

/// One part as read, and its record without knots.
struct MateBody {
  BodyRecord record;
  MatePart part;
  std::vector<std::string> decisions;  ///< of reading it, one line each
};

/// Reads a part.
[[nodiscard]] MateBody read_mate_body(const std::string& path, const MateSettings& settings);

/// Reads a part of an earlier run again, its checksum verified.
/// @param name  "fixed" or "moving"
/// @param path  where it is now; empty = where it was
[[nodiscard]] MateBody read_recorded_part(const BodyRecord& record, const Provenance& provenance,
                                          const std::string& name, const std::string& path,
                                          const MateSettings& settings);

/// @throws InputError if the two files give different units. Where one gives none, its decisions
/// say what it is taken to be.
void expect_one_unit(MateBody& fixed, MateBody& moving);

/// Mates, and checks the contact of the best poses exactly: columns contact_area,
/// penetration_volume, penetration_depth, pull_blocked and pull_x, pull_y, pull_z of the run.
/// run.seconds and figures of time are left to the caller. A random start moves the part by up to
/// half its diameter per axis.
/// @param earlier  a checkpoint of the same inputs and settings to go on from
[[nodiscard]] SearchResult mate(const MateBody& fixed, const MateBody& moving,
                                const MateSettings& settings, const Provenance& provenance,
                                const SearchWatch& watch, const Run* earlier = nullptr);

}  // namespace mortise::app
