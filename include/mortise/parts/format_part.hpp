// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Parts, moved or not, as the bytes of STL, PLY, OFF, OBJ and STEP files.
#pragma once

#include <string>

#include "mortise/core/rigid_motion.hpp"
#include "mortise/parts/triangle_mesh.hpp"

namespace mortise {

/// Largest mesh that format_step() takes; a STEP file has about 1 kB per triangle.
inline constexpr Eigen::Index kMostStepTriangles = 50000;

/// A binary STL file of the mesh moved by `motion`. Coordinates are single precision.
/// @throws InputError if there are more than 2^32 - 1 triangles or a coordinate does not fit
[[nodiscard]] std::string format_stl(const TriangleMesh& mesh, const RigidMotion& motion = {});

/// A binary little-endian PLY file of the mesh moved by `motion`, double precision, vertices shared
/// and in the same order.
[[nodiscard]] std::string format_ply(const TriangleMesh& mesh, const RigidMotion& motion = {});

/// OFF and OBJ text of the mesh, vertices shared and in the same order. Numbers are the shortest
/// that read back to the same bits.
[[nodiscard]] std::string format_off(const TriangleMesh& mesh);
[[nodiscard]] std::string format_obj(const TriangleMesh& mesh);

/// A STEP file (AP214) with one plane face per triangle, moved by `motion`.
/// @param unit  "mm", "cm", "m", "in", ...: the unit of the coordinates
/// @throws InputError for more than kMostStepTriangles triangles or an unknown unit
[[nodiscard]] std::string format_step(const TriangleMesh& mesh, const RigidMotion& motion = {},
                                      const std::string& unit = "mm");

/// The STEP file `path` with its shapes moved, curved faces and unit kept.
/// @param motion  in the file's own unit
/// @throws FileError if `path` is no STEP file
[[nodiscard]] std::string format_moved_step(const std::string& path, const RigidMotion& motion);

}  // namespace mortise
