// SPDX-License-Identifier: GPL-3.0-or-later
// How well each clearance of a mating fits, for people and for scripts.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "mortise/store/run_file.hpp"

namespace mortise::app {

/// Whether a run's figure is one of those below, which are shown together.
[[nodiscard]] bool is_clearance_figure(const Figure& figure);

/// A line on the clearance that fits best and one for each with its best score; empty for a run
/// that searched none.
[[nodiscard]] std::string clearance_lines(const Run& run);

/// Adds "best_clearance" and "clearances", a list of {"clearance", "best_score"}, to what is told
/// of a run; nothing for a run that searched none.
void add_clearances(nlohmann::ordered_json& json, const Run& run);

}  // namespace mortise::app
