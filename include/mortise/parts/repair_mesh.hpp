// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Making a closed, outward surface of triangles as they come out of a file.
#pragma once

#include <string>
#include <vector>

#include "mortise/parts/triangle_mesh.hpp"

namespace mortise {

struct RepairOptions {
  bool allow_open = false;  ///< accept a surface that cannot be closed as it is; its inside is
                            ///< then where the winding number is above 1/2
  double merge_tolerance = 1e-6;  ///< points of open edges nearer than this are one; part of the
                                  ///< bounding box's diagonal, [0, 0.01]
  double largest_hole = 0.25;     ///< longest extent of a hole that is filled; part of the diagonal
  bool find_self_intersections = true;  ///< look for triangles that cross; costs about as much as
                                        ///< everything else
};

struct RepairResult {
  TriangleMesh mesh;            ///< no vertex unused, no triangle without area
  bool closed = false;          ///< every edge is walked once each way by its triangles
  double volume = 0.0;          ///< of all closed shells, cubic units of the mesh, cavities
                                ///< negative, overlaps twice; > 0 if closed
  double deviation = 0.0;       ///< of a surface that was wrapped: how far the wrap lies from
                                ///< its faces, length unit of the mesh; else 0
  long self_intersections = 0;  ///< pairs of triangles that cross; 0 if not looked for
  std::vector<std::string> decisions;  ///< what was changed or found, one line each; empty: nothing
};

/// Merges equal points, drops triangles without area and repeated ones, keeps one of two triangles
/// that are both sides of a face, turns the triangles of each shell the same way and outward (a
/// shell inside another one keeps its side, so that a cavity stays a cavity), merges points across
/// seams and fills small holes.
///
/// What is then still open stays as it is if its winding number tells inside from outside nearly
/// everywhere (cracks, T-junctions); inside is then where that number is above 1/2. Otherwise faces
/// count that have the outside on one side and the inside on the other, where the outside is what a
/// ball with a radius of 1/80 of the diagonal can reach. They are turned outward; sheets in the
/// open and walls inside are dropped. Faces that leave more than cracks between them are wrapped,
/// 1/600 of the diagonal outside (CGAL's alpha_wrap_3). Where nothing is enclosed, cracks of up to
/// 1e-3 of the diagonal and openings in one plane are closed.
///
/// Edges of more than two triangles and crossing triangles are kept and reported: inside is where
/// the winding number is not zero.
/// @param soup  triangles that may or may not share vertices
/// @throws InputError if a vertex is not finite, an index is out of range, nothing is left, the
///         surface has one side only or is open and encloses nothing (the number of open edges, the
///         first one, crossing triangles), unless options.allow_open, or its volume is zero
/// Time O(T log T), T triangles.
[[nodiscard]] RepairResult repair_mesh(const TriangleMesh& soup, const RepairOptions& options = {});

}  // namespace mortise
