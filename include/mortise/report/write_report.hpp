// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A run's report: the page, the numbers as tables, the best poses as files, scripts for other
/// viewers.
#pragma once

#include <string>
#include <vector>

#include "mortise/report/bodies.hpp"
#include "mortise/report/clusters.hpp"
#include "mortise/store/run_file.hpp"

namespace mortise {

struct ReportOptions {
  int structures = 10;  ///< best poses written as structure files; >= 0
  ReportClusterOptions clusters = {};
  /// best poses of molecules whose interface is described (interface_columns), unless the run has
  /// these columns; 0 = none; >= 0
  int interfaces = 50;
  int part_triangles = 40'000;  ///< as PageOptions::part_triangles; >= 100
  int pictures = 0;  ///< best poses drawn as PNG, and the plots with them; 0 = none; >= 0
  int threads = 0;   ///< 0 = all cores; never changes the result
};

struct PreparedReport {
  Run run;
  ReportClusters clusters;
};

/// The run as the report shows it: clustered as cluster_run() does; the best poses' interfaces
/// described; an unfinished run's best raw candidates as its poses if it has no others.
/// @throws InputError if an option is out of range; as cluster_run
[[nodiscard]] PreparedReport prepare_report(const Run& run, const ReportBodies& bodies,
                                            const ReportOptions& options = {});

struct ReportFiles {
  std::vector<std::string> files;     ///< written, relative to the directory
  std::vector<std::string> warnings;  ///< one line each: what was left out and why
};

/// Writes index.html, poses.csv, poses.json, clusters.csv, clusters.json, the best poses below
/// poses/ (PDB, mmCIF where PDB has no room, STL for parts) and poses.pml and poses.cxc, which show
/// these in PyMOL and ChimeraX.
/// @param directory  made if it is not there; files of the same names are replaced
/// @throws FileError if it cannot be written; InputError as prepare_report and report_page
[[nodiscard]] ReportFiles write_report(const Run& run, const ReportBodies& bodies,
                                       const std::string& directory,
                                       const ReportOptions& options = {});

}  // namespace mortise
