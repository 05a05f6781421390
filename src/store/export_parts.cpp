// SPDX-License-Identifier: GPL-3.0-or-later
// Placed parts as STL, PLY and STEP.
#include "mortise/core/errors.hpp"
#include "mortise/parts/format_part.hpp"
#include "mortise/store/export.hpp"

namespace mortise {
namespace {

void expect_parts(const Run& run) {
  if (of_molecules(run))
    throw InputError("formats stl, ply and step are for parts; this is a " + run.kind +
                     " run of molecules");
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

ExportParts read_export_parts(const Run& run, const LocateOptions& fixed,
                              const LocateOptions& moving, const ExportOptions& options) {
  expect_parts(run);
  ExportParts parts;
  if (options.complex) {
    const Body body = read_input_body(run.fixed, run.provenance, "fixed", fixed);
    parts.fixed = body_mesh(body);
    parts.fixed_unit = body.record.unit;
  }
  parts.moving_path = locate_input(run.moving, run.provenance, "moving", moving);
  const Body body = read_input_body(run.moving, run.provenance, "moving", moving);
  parts.moving = body_mesh(body);
  parts.moving_unit = body.record.unit;
  return parts;
}

std::string export_part(const Run& run, ExportFormat format, std::size_t pose,
                        const ExportParts& parts, const ExportOptions& options) {
  expect_parts(run);
  if (pose >= run.poses.poses.size())
    throw InputError("export: pose " + std::to_string(pose + 1) + ": the run holds " +
                     std::to_string(run.poses.poses.size()) + " poses");
  const RigidMotion& motion = run.poses.poses[pose].moving_in_fixed;
  if (format == ExportFormat::kStep && !options.complex && run.moving.kind == "part" &&
      is_step_file(parts.moving_path))
    return format_moved_step(parts.moving_path, motion);
  TriangleMesh placed = parts.moving;
  placed.vertices = motion * placed.vertices;
  std::string unit = parts.moving_unit;
  if (options.complex) {
    const std::string& other = parts.fixed_unit;
    if (!unit.empty() && !other.empty() && unit != other)
      throw InputError("export: the fixed part is in " + other + ", the moving one in " + unit);
    if (unit.empty()) unit = other;
    placed = join(parts.fixed, placed);
  }
  switch (format) {
    case ExportFormat::kStl:
      return format_stl(placed);
    case ExportFormat::kPly:
      return format_ply(placed);
    case ExportFormat::kStep:
      return format_step(placed, {}, unit.empty() || unit == "angstrom" ? "mm" : unit);
    default:
      throw InputError("export: expected stl, ply or step for parts");
  }
}

}  // namespace mortise
