// SPDX-License-Identifier: GPL-3.0-or-later
// mortise evaluate for runs of parts.
#pragma once

#include <string>

#include "commands.hpp"
#include "mortise/store/inputs.hpp"

namespace mortise::app {

/// Measures a mating run's poses against their true placement: adds the columns placement_largest
/// and placement_rms (relative to the moving part's diameter) to the run and prints the summary.
/// @param truth  truth file; @param pair  name of the pair in it, or empty = by the parts' names
/// @param moving where the moving part's file is now
void evaluate_parts(const std::string& run_path, const std::string& truth, const std::string& pair,
                    const LocateOptions& moving, const CommonOptions& common);

}  // namespace mortise::app
