// SPDX-License-Identifier: GPL-3.0-or-later
// Boundary representations of OpenCASCADE: read, tessellated, moved, written. Private to the STEP
// module and to tools/make_parts.
#pragma once

#include <TopoDS_Shape.hxx>
#include <string>

#include "mortise/core/rigid_motion.hpp"
#include "mortise/parts/triangle_mesh.hpp"
#include "parts/step/kernel.hpp"

namespace mortise::brep {

/// A shape with the unit its file states. Coordinates are in millimetres, whatever the unit.
struct UnitShape {
  TopoDS_Shape shape;
  std::string unit = "mm";
  double millimetres = 1.0;  ///< per unit
};

/// @throws FileError if the file is no STEP file or holds no shape
[[nodiscard]] UnitShape read(const std::string& path);

/// Triangles by face, corners counter-clockwise from outside; the shape's own coordinates.
[[nodiscard]] TriangleMesh tessellate(const TopoDS_Shape& shape, const Fineness& fineness);

/// A copy with the motion worked into its geometry.
[[nodiscard]] TopoDS_Shape moved(const TopoDS_Shape& shape, const RigidMotion& motion);

/// A solid (a compound of solids if there are several shells) of planar triangles.
[[nodiscard]] TopoDS_Shape faceted(const TriangleMesh& mesh);

/// The bytes of an AP214 file; the same shape gives the same bytes.
[[nodiscard]] std::string to_step(const UnitShape& part);

/// Longest side-to-side diagonal of the shape's bounding box.
[[nodiscard]] double diagonal(const TopoDS_Shape& shape);

/// @throws InputError if the unit is none that STEP files are written in
[[nodiscard]] double millimetres_per(const std::string& unit);

}  // namespace mortise::brep
