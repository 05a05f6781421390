// SPDX-License-Identifier: GPL-3.0-or-later
// A union of balls, or a mesh, written in the form that the file's name asks for.
#pragma once

#include <Eigen/Core>
#include <string>

#include "commands.hpp"
#include "mortise/parts/triangle_mesh.hpp"

namespace mortise::app {

/// Throws InputError unless the name ends in .h5, .xyzr, .stl, .ply, .off or .obj, `balls` false:
/// in one of the last four.
void check_shape_name(const std::string& path, bool balls);
/// Whether a file of this name holds triangles.
[[nodiscard]] bool is_mesh_name(const std::string& path);

/// Balls as a knots file or as plain balls. @param figures  kept in a knots file
void write_balls(const std::string& path, const Eigen::Matrix4Xd& balls, const std::string& source,
                 const nlohmann::ordered_json& options, const nlohmann::ordered_json& figures);

void write_mesh(const std::string& path, const TriangleMesh& mesh);

/// {"triangles", "area", "volume"} of a closed mesh.
[[nodiscard]] nlohmann::ordered_json mesh_figures(const TriangleMesh& mesh);

/// What makes an answer out of all balls of a sum or a sweep.
struct ShapeOptions {
  CommonOptions common;
  std::string output;
  double slack = 0.0;
  double spacing = 0.0;
  bool force = false;
};

/// Adds -o, --slack, --spacing and --force. @param what  "the obstacle", ...
void add_shape_options(CLI::App& command, ShapeOptions& options, const std::string& what);

/// Drops balls, writes the file and adds balls or triangles to the figures.
/// @param error  of the balls given, to which the slack is added
void finish_shape(Eigen::Matrix4Xd balls, double error, const std::string& source,
                  const ShapeOptions& options, const nlohmann::ordered_json& resolved,
                  nlohmann::ordered_json& figures);

/// Prints the figures as JSON, or as a table of `lines`, or nothing.
void print_shape(const ShapeOptions& options, const nlohmann::ordered_json& figures,
                 const std::string& lines);

}  // namespace mortise::app
