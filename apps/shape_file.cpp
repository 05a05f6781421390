// SPDX-License-Identifier: GPL-3.0-or-later
// Balls and meshes to files, and what is said about them.
#include "shape_file.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "mortise/collision/minkowski.hpp"
#include "mortise/core/errors.hpp"
#include "mortise/parts/format_part.hpp"
#include "mortise/parts/uncontained_balls.hpp"
#include "mortise/parts/union_mesh.hpp"
#include "mortise/store/atomic_file.hpp"
#include "mortise/store/balls_file.hpp"
#include "mortise/store/knots_file.hpp"
#include "output_guard.hpp"

namespace mortise::app {
namespace {

std::string ending(const std::string& path) {
  std::string end = std::filesystem::path(path).extension().string();
  std::transform(end.begin(), end.end(), end.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return end;
}

bool is_mesh_name(const std::string& path) {
  const std::string end = ending(path);
  return end == ".stl" || end == ".ply" || end == ".off" || end == ".obj";
}

// The name must end in .h5, .xyzr, .stl, .ply, .off or .obj, `balls` false: in one of the last
// four.
void check_shape_name(const std::string& path, bool balls) {
  const std::string end = ending(path);
  if (is_mesh_name(path) || (balls && (end == ".h5" || end == ".xyzr"))) return;
  throw FileError(path, std::string("expected a name that ends in ") +
                            (balls ? ".h5 or .xyzr (balls), " : "") +
                            ".stl, .ply, .off or .obj (mesh)");
}

// The figures are kept in a knots file.
void write_balls(const std::string& path, const Eigen::Matrix4Xd& balls, const std::string& source,
                 const nlohmann::ordered_json& options, const nlohmann::ordered_json& figures) {
  const Knots knots{balls, Eigen::VectorXcd::Ones(balls.cols())};
  if (named_xyzr(path)) {
    write_xyzr(path, knots);
    return;
  }
  KnotsFile file;
  file.provenance = make_provenance(command_line(), options.dump());
  file.source_path = source;
  file.source_sha256 = sha256_of_file(source);
  file.knots = knots;
  for (const auto& [name, value] : figures.items())
    if (value.is_number() && name != "seconds") file.figures.push_back({name, value.get<double>()});
  write_knots_file(path, file);
}

}  // namespace

void write_mesh(const std::string& path, const TriangleMesh& mesh) {
  const std::string end = ending(path);
  write_file_atomically(path, end == ".stl"   ? format_stl(mesh)
                              : end == ".ply" ? format_ply(mesh)
                              : end == ".off" ? format_off(mesh)
                                              : format_obj(mesh));
}

nlohmann::ordered_json mesh_figures(const TriangleMesh& mesh) {
  double area = 0.0, volume = 0.0;
  for (const auto t : mesh.triangles.colwise()) {
    const Eigen::Vector3d origin = mesh.vertices.col(0), a = mesh.vertices.col(t[0]) - origin,
                          b = mesh.vertices.col(t[1]) - origin,
                          c = mesh.vertices.col(t[2]) - origin;
    area += 0.5 * (b - a).cross(c - a).norm();
    volume += a.dot(b.cross(c)) / 6.0;
  }
  return {{"triangles", mesh.size()}, {"area", area}, {"volume", volume}};
}

void add_shape_options(CLI::App& command, ShapeOptions& options, const std::string& what,
                       const std::string& offset) {
  command
      .add_option("-o,--output", options.output,
                  what +
                      ": balls as NAME.h5 or NAME.xyzr, or their boundary as NAME.stl, .ply, "
                      ".off or .obj")
      ->required();
  command
      .add_option("--grid", options.grid,
                  "Parts: nodes along the longest side of their decomposition")
      ->capture_default_str()
      ->check(CLI::Range(2, 1024));
  command.add_option("--offset", options.offset, "Grow (or shrink, if negative) " + offset)
      ->capture_default_str();
  command
      .add_option("--slack", options.slack,
                  "Drop balls that lie in another one grown by this length, and grow all by it; "
                  "makes few of many")
      ->capture_default_str()
      ->check(CLI::NonNegativeNumber);
  command
      .add_option("--spacing", options.spacing,
                  "Meshes: spacing of the grid that they are made on, length; 0 = longest side / "
                  "128")
      ->capture_default_str()
      ->check(CLI::NonNegativeNumber);
  command.add_flag("--force", options.force, "Replace the output file if it is there");
}

void check_shape_options(const ShapeOptions& options, bool balls,
                         const std::vector<std::string>& inputs) {
  check_shape_name(options.output, balls);
  check_output_file(options.output, inputs, options.force, "--force replaces it");
  if (!std::isfinite(options.offset)) throw InputError("--offset must be finite");
}

void finish_shape(Eigen::Matrix4Xd balls, double error, const std::string& source,
                  const ShapeOptions& options, const nlohmann::ordered_json& resolved,
                  nlohmann::ordered_json& figures) {
  if (options.slack > 0.0) {
    balls = Eigen::Matrix4Xd(balls(Eigen::all, uncontained_balls(balls, options.slack)));
    balls.row(3).array() += options.slack;
  }
  if (balls.cols() == 0)
    throw InputError("the offset leaves nothing: no ball has a radius larger than 0");
  figures["balls"] = balls.cols();
  figures["error"] = error + options.slack;
  const Eigen::Vector3d low = (balls.topRows<3>().rowwise() - balls.row(3)).rowwise().minCoeff();
  const Eigen::Vector3d high = (balls.topRows<3>().rowwise() + balls.row(3)).rowwise().maxCoeff();
  figures["low"] = {low[0], low[1], low[2]};
  figures["high"] = {high[0], high[1], high[2]};
  if (is_mesh_name(options.output)) {
    const TriangleMesh mesh =
        union_mesh(balls, {.spacing = options.spacing, .threads = options.common.threads});
    write_mesh(options.output, mesh);
    figures["spacing"] = options.spacing > 0.0 ? options.spacing : (high - low).maxCoeff() / 128.0;
    figures.update(mesh_figures(mesh));
  } else {
    write_balls(options.output, balls, source, resolved, figures);
  }
}

void print_shape(const ShapeOptions& options, const nlohmann::ordered_json& figures,
                 const std::string& lines) {
  if (options.common.json) {
    std::printf("%s\n", figures.dump().c_str());
    return;
  }
  if (options.common.quiet) return;
  const auto number = [&](const char* name) { return figures[name].get<double>(); };
  std::fputs(lines.c_str(), stdout);
  if (figures.contains("balls"))
    std::printf("balls     %ld, after dropping those that lie in others\n",
                figures["balls"].get<long>());
  if (figures.contains("triangles"))
    std::printf("mesh      %ld triangles on a grid of %.4g; area %.6g, volume %.6g\n",
                figures["triangles"].get<long>(), number("spacing"), number("area"),
                number("volume"));
  std::printf("error     %.4g at most, by the balls%s\n", number("error"),
              figures.contains("triangles") ? "; the mesh's own comes on top" : "");
  std::printf("time      %.3f s\nwrote     %s\n", number("seconds"), options.output.c_str());
}

}  // namespace mortise::app
