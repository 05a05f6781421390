// SPDX-License-Identifier: GPL-3.0-or-later
// A union of balls, or a mesh, written in the form that the file's name asks for.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "ball_body.hpp"
#include "commands.hpp"
#include "mortise/parts/triangle_mesh.hpp"

namespace mortise::app {

void write_mesh(const std::string& path, const TriangleMesh& mesh);

/// {"triangles", "area", "volume"} of a closed mesh.
[[nodiscard]] nlohmann::ordered_json mesh_figures(const TriangleMesh& mesh);

/// What makes an answer out of all balls of a sum or a sweep.
struct ShapeOptions {
  CommonOptions common;
  std::string output;
  int grid = BallBodyOptions().grid;
  double offset = 0.0;
  double slack = 0.0;
  double spacing = 0.0;
  bool force = false;
};

/// Adds -o, --grid, --offset, --slack, --spacing and --force.
/// @param what    "The obstacle", ...
/// @param offset  what an offset does to it
void add_shape_options(CLI::App& command, ShapeOptions& options, const std::string& what,
                       const std::string& offset);

/// @param balls   whether the answer may be balls
/// @param inputs  files that must not be replaced
/// @throws FileError, InputError if the output's name or the offset will not do
void check_shape_options(const ShapeOptions& options, bool balls,
                         const std::vector<std::string>& inputs);

/// Drops balls, writes the file and adds balls or triangles to the figures.
/// @param error  of the balls given, to which the slack is added
void finish_shape(Eigen::Matrix4Xd balls, double error, const std::string& source,
                  const ShapeOptions& options, const nlohmann::ordered_json& resolved,
                  nlohmann::ordered_json& figures);

/// Prints the figures as JSON, or as a table of `lines`, or nothing.
void print_shape(const ShapeOptions& options, const nlohmann::ordered_json& figures,
                 const std::string& lines);

}  // namespace mortise::app
