// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Points spread evenly over a part's surface.
#pragma once

#include <Eigen/Core>

#include "mortise/parts/triangle_mesh.hpp"

namespace mortise {

/// Points on a surface, each standing for the same area. Any first n of them cover the surface
/// evenly too, each for N / n times the area.
struct SurfaceSamples {
  Eigen::Matrix3Xd points;   ///< 3 x N, input frame
  Eigen::Matrix3Xd normals;  ///< 3 x N, outward, unit length
  double area = 0.0;         ///< of the whole surface

  [[nodiscard]] Eigen::Index size() const noexcept { return points.cols(); }
};

/// The area of all triangles.
[[nodiscard]] double surface_area(const TriangleMesh& mesh);

/// Quasi-random points: along the triangles' summed areas by the golden ratio, within a triangle by
/// the plastic number's sequence, so that prefixes are even. Deterministic.
/// @throws InputError if the mesh has no area
[[nodiscard]] SurfaceSamples sample_surface(const TriangleMesh& mesh, Eigen::Index count);

}  // namespace mortise
