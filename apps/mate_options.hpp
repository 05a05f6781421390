// SPDX-License-Identifier: GPL-3.0-or-later
// The options of mating as the command line and the run file spell them: one table for both.
#pragma once

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "mortise/runs/mate.hpp"
#include "search_command.hpp"

namespace mortise::app {

/// All that decides what a mating run finds, but for its two inputs.
struct MateSettings {
  MateOptions options;
  double deviation = 0.0;  ///< of a STEP file's tessellation, length unit; 0 = the reader's default
  int checked = 10;        ///< best poses whose contact is checked exactly; >= 0
  bool allow_open = false;                    ///< accept parts that cannot be closed
  std::optional<std::uint64_t> random_start;  ///< seed of the moving part's start; none = as it is
};

using MateArguments = SearchArguments<MateSettings>;

/// Adds --preset and the options of the table to a command, with the default preset's values.
void add_mate_options(CLI::App& command, MateArguments& arguments);

/// `start` (the default preset if there is none), or the preset where one is asked for, and the
/// user's settings over it.
[[nodiscard]] MateSettings resolve(const MateArguments& arguments,
                                   const std::optional<MateSettings>& start = {});

/// The settings as the run file records them.
[[nodiscard]] nlohmann::ordered_json settings_json(const MateSettings& settings);

/// The settings that settings_json() recorded. @throws InputError if this program does not know all
/// of them
[[nodiscard]] MateSettings parse_mate_settings(const std::string& json);

}  // namespace mortise::app
