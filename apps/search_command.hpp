// SPDX-License-Identifier: GPL-3.0-or-later
// The commands dock and mate as one, which differ in their words.
#pragma once

#include <string>

#include "commands.hpp"
#include "mortise/runs/run_kind.hpp"

namespace mortise::app {

/// What a search command says.
struct SearchWords {
  const char* description;
  const char* fixed;         ///< help of the input FIXED
  const char* moving;        ///< help of the input MOVING
  const char* fixed_label;   ///< of the line on the fixed body: "receptor"
  const char* moving_label;  ///< likewise: "ligand"
  const char* started;       ///< what --random-start moves: "ligand"
  const char* label;         ///< of the progress bar
  const char* unit;          ///< of lengths: " A", or nothing
  const char* preset_help;   ///< added to the help of --preset
  const char* examples;
};

/// Adds the command of a kind of run.
void add_search_command(CLI::App& program, const RunKind<DockOptions>& kind,
                        const SearchWords& words);
void add_search_command(CLI::App& program, const RunKind<MateOptions>& kind,
                        const SearchWords& words);

}  // namespace mortise::app
