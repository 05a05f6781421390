// SPDX-License-Identifier: GPL-3.0-or-later
// One docking from two structure files to a run: what `dock` and `benchmark` both do.
#pragma once

#include <string>
#include <vector>

#include "dock_options.hpp"
#include "mortise/store/run_file.hpp"
#include "search_job.hpp"

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

/// Docks. run.seconds and figures of time are left to the caller. A random start moves the ligand
/// by up to 50 angstrom per axis.
/// @param earlier  a checkpoint of the same inputs and settings to go on from
[[nodiscard]] SearchResult dock(const DockBody& fixed, const DockBody& moving,
                                const DockSettings& settings, const Provenance& provenance,
                                const SearchWatch& watch, const Run* earlier = nullptr);

}  // namespace mortise::app
