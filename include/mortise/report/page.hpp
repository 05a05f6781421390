// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The ranked-pose page: one HTML file that needs nothing else.
#pragma once

#include <string>

#include "mortise/report/bodies.hpp"
#include "mortise/report/clusters.hpp"
#include "mortise/store/run_file.hpp"

namespace mortise {

/// False in a build with MORTISE_REPORT=OFF, which has no page.
[[nodiscard]] bool report_page_available() noexcept;

/// How often each residue of the fixed molecule (each vertex of the fixed mesh) is touched.
///
/// A residue is touched in a pose that brings a heavy atom of the moving body within `cutoff` of
/// one of its atoms; a vertex likewise with the moving mesh's vertices and triangle centres.
/// @param poses  so many poses count, from the best; >= 1
/// @return shares in [0, 1], one per residue or vertex; all 0 without poses
[[nodiscard]] Eigen::VectorXd touch_frequency(const Run& run, const ReportBodies& bodies,
                                              double cutoff, int poses, int threads = 0);

struct PageOptions {
  ReportClusters clusters = {};  ///< of the run's poses, as cluster_run() gave them
  int frequency_poses = 1000;    ///< best poses that the map on the surface counts; >= 1
  int part_triangles = 40'000;   ///< a larger part is simplified to about so many; >= 100
  int threads = 0;               ///< 0 = all cores; never changes the result
};

/// The page as HTML text, about 0.6 MB and 30 bytes per number of the run.
///
/// A part has about PageOptions::part_triangles in it at most; the page says how far that moved the
/// surface, as measured. The fixed part's large triangles are cut up, for its colours.
/// All names and paths from files are data inside it, never markup; it loads nothing from outside
/// and its content security policy says so.
/// @throws InputError without report_page_available(), or as check_run
[[nodiscard]] std::string report_page(const Run& run, const ReportBodies& bodies,
                                      const PageOptions& options = {});

}  // namespace mortise
