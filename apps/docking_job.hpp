// SPDX-License-Identifier: GPL-3.0-or-later
// One docking from two structure files to a run: what `dock` and `benchmark` both do.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "dock_options.hpp"
#include "mortise/core/progress.hpp"
#include "mortise/store/run_file.hpp"

namespace mortise::app {

/// One body as read, and its record without knots.
struct DockBody {
  BodyRecord record;
  Molecule molecule;
  std::vector<std::string> decisions;  ///< of reading it, one line each
};

/// Reads a body. `text` is path[#model][:chains].
[[nodiscard]] DockBody read_dock_body(const std::string& text, const ReadMoleculeOptions& options);

/// Reads a body of an earlier run again, its checksum verified.
/// @param name  "fixed" or "moving"
/// @param text  where it is now; empty = where it was. @throws InputError unless it names the same
/// model and chains
[[nodiscard]] DockBody read_recorded_body(const BodyRecord& record, const Provenance& provenance,
                                          const std::string& name, const std::string& text,
                                          const ReadMoleculeOptions& options);

/// A random rotation and a translation of up to 50 angstrom per axis, the same for a seed
/// everywhere.
[[nodiscard]] RigidMotion random_start(std::uint64_t seed);

struct DockWatch {
  std::function<void()>
      prepared;  ///< called once, when nothing is left to be refused; may be empty
  ProgressCallback progress;
  double checkpoint_seconds = 30.0;                 ///< between two calls of save; >= 0
  std::function<void(const Run& unfinished)> save;  ///< without poses; empty = none
};

struct DockFigures {
  std::array<int, 3> grid_size = {};
  double spacing = 0.0;
  double seconds_prepare = 0.0;  ///< knots, rotations, spectra of the fixed body
  double seconds_search = 0.0;
  double seconds_rank = 0.0;
  bool whole = false;  ///< the search ran from the first to the last rotation here
};

struct DockResult {
  Run run;  ///< complete, or with a checkpoint and the poses so far
  DockFigures figures;
};

/// Docks. run.seconds and figures of time are left to the caller.
/// @param earlier  a checkpoint of the same inputs and settings to go on from
[[nodiscard]] DockResult dock(const DockBody& fixed, const DockBody& moving,
                              const DockSettings& settings, const Provenance& provenance,
                              const DockWatch& watch, const Run* earlier = nullptr);

}  // namespace mortise::app
