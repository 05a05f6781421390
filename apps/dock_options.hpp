// SPDX-License-Identifier: GPL-3.0-or-later
// The options of docking as the command line and the run file spell them: one table for both.
#pragma once

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "mortise/molecules/read_molecule.hpp"
#include "mortise/runs/dock.hpp"
#include "search_command.hpp"

namespace mortise::app {

/// All that decides what a docking run finds, but for its two inputs.
struct DockSettings {
  DockOptions options;
  ReadMoleculeOptions read;
  std::optional<std::uint64_t> random_start;  ///< seed of the moving body's start; none = as it is
};

/// What the user asked for.
using DockArguments = SearchArguments<DockSettings>;

/// Adds --preset and the options of the table to a command, with the default preset's values.
void add_dock_options(CLI::App& command, DockArguments& arguments);

/// `start` (the default preset if there is none), or the preset where one is asked for, and the
/// user's settings over it.
[[nodiscard]] DockSettings resolve(const DockArguments& arguments,
                                   const std::optional<DockSettings>& start = {});

/// The settings as the run file records them.
[[nodiscard]] nlohmann::ordered_json settings_json(const DockSettings& settings);

/// The settings that settings_json() recorded. @throws InputError if this program does not know all
/// of them
[[nodiscard]] DockSettings parse_settings(const std::string& json);

}  // namespace mortise::app
