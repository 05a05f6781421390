// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Pictures without a browser or a display: poses by the ray tracer POV-Ray, plots by matplotlib.
#pragma once

#include <string>
#include <vector>

#include "mortise/report/bodies.hpp"
#include "mortise/store/run_file.hpp"

namespace mortise {

struct PictureOptions {
  int width = 1200;  ///< pixels; 16 to 10,000
  int height = 900;  ///< likewise
  int threads = 0;   ///< 0 = all cores
};

/// A POV-Ray scene of both bodies at a pose: the fixed molecule as a Gaussian surface and the
/// moving one as a ribbon, parts as meshes with their sharp edges, the fixed one see-through.
///
/// Seen in parallel projection, molecules at right angles to the line between the bodies, parts
/// obliquely from above along the fixed one's flat faces; everything is in the picture.
/// @param pose  carries the moving body to its place
/// @throws InputError if a body is empty or an option out of range
[[nodiscard]] std::string povray_scene(const ReportBodies& bodies, const RigidMotion& pose,
                                       const PictureOptions& options = {});

/// Renders a scene to a PNG file with the program `povray`.
/// @throws InputError if the program is missing or fails, with what it said
void render_scene(const std::string& scene, const std::string& png_path,
                  const PictureOptions& options = {});

/// Draws scores.png, and with interface_rmsd or placement_largest among the metrics funnel.png and
/// best_of_top.png (the best of it, and DockQ, among the first so many poses), with Python's
/// matplotlib.
/// @return names of the files, relative to the directory
/// @throws InputError if Python or matplotlib is missing or fails, with what it said
[[nodiscard]] std::vector<std::string> draw_plots(const Run& run, const std::string& directory);

/// How soon a criterion is met, pair by pair of a benchmark.
struct SuccessCurve {
  std::string name;
  std::vector<double> first_ranks;  ///< one per pair, from 1; NaN = never
};

/// Draws the share of pairs that have met each criterion among the first so many poses.
/// @param most  poses at the curve's end; >= 1
/// @throws InputError as draw_plots, or if there is no curve or a curve has no pair
void draw_success(const std::vector<SuccessCurve>& curves, int most, const std::string& png_path);

}  // namespace mortise
