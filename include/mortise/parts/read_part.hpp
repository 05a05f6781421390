// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Reading a part from a mesh or a STEP file.
#pragma once

#include <string>
#include <vector>

#include "mortise/parts/repair_mesh.hpp"
#include "mortise/parts/triangle_mesh.hpp"

namespace mortise {

struct ReadPartOptions {
  double deviation = 5e-4;  ///< STEP: largest distance between surface and triangles, part of the
                            ///< bounding box's diagonal; > 0
  double absolute_deviation = 0.0;  ///< the same in the file's unit; 0 = use `deviation`
  double angle = 0.35;  ///< STEP: largest turn of the normal from triangle to triangle, radians
  RepairOptions repair = {};
};

struct ReadPartResult {
  TriangleMesh mesh;  ///< coordinates as in the file, in its own unit
  std::string unit;   ///< "mm", "in", ... of a STEP file; empty if the format knows no unit
  bool closed = false;
  double volume = 0.0;                 ///< as in RepairResult, cubic units of the file
  double deviation = 0.0;              ///< STEP: the one used, unit of the file; else 0
  std::vector<std::string> decisions;  ///< what was repaired, one line each
};

/// Reads STL (ASCII, binary), OBJ, PLY, OFF or STEP, whichever the content says, and repairs it
/// with repair_mesh(). Polygons are triangulated.
/// @throws FileError if the file is missing, a directory, empty, of another kind, cut off, or the
///         surface cannot be made a closed one (see repair_mesh)
/// @throws InputError if an option is out of range
[[nodiscard]] ReadPartResult read_part(const std::string& path,
                                       const ReadPartOptions& options = {});

/// Whether the file's first bytes are those of a STEP file. @throws FileError if it is unreadable
[[nodiscard]] bool is_step_file(const std::string& path);

}  // namespace mortise
