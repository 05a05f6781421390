// SPDX-License-Identifier: GPL-3.0-or-later
// Placed parts as STL, PLY and STEP.
#include "mortise/core/errors.hpp"
#include "mortise/parts/format_part.hpp"
#include "mortise/parts/read_part.hpp"
#include "mortise/store/export.hpp"

namespace mortise {
namespace {

ReadPartResult read(const std::string& path) {
  return read_part(path, {.repair = {.allow_open = true, .find_self_intersections = false}});
}

TriangleMesh join(const TriangleMesh& a, const TriangleMesh& b) {
  TriangleMesh both;
  both.vertices.resize(3, a.vertices.cols() + b.vertices.cols());
  both.vertices << a.vertices, b.vertices;
  both.triangles.resize(3, a.size() + b.size());
  both.triangles << a.triangles, b.triangles.array() + static_cast<int>(a.vertices.cols());
  return both;
}

}  // namespace

std::string export_part(const Run& run, ExportFormat format, std::size_t pose,
                        const std::string& fixed_path, const std::string& moving_path,
                        const ExportOptions& options) {
  if (run.kind != "mate")
    throw InputError("formats stl, ply and step are for parts; this is a " + run.kind + " run");
  if (pose >= run.poses.poses.size())
    throw InputError("export: pose " + std::to_string(pose + 1) + ": the run holds " +
                     std::to_string(run.poses.poses.size()) + " poses");
  const RigidMotion& motion = run.poses.poses[pose].moving_in_fixed;
  if (format == ExportFormat::kStep && !options.complex && is_step_file(moving_path))
    return format_moved_step(moving_path, motion);
  const ReadPartResult moving = read(moving_path);
  TriangleMesh placed = moving.mesh;
  placed.vertices = motion * placed.vertices;
  if (options.complex) placed = join(read(fixed_path).mesh, placed);
  switch (format) {
    case ExportFormat::kStl:
      return format_stl(placed);
    case ExportFormat::kPly:
      return format_ply(placed);
    case ExportFormat::kStep:
      return format_step(placed, {}, moving.unit.empty() ? "mm" : moving.unit);
    default:
      throw InputError("export: expected stl, ply or step for parts");
  }
}

}  // namespace mortise
