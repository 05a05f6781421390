// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The surface between the nodes of a grid that are inside and those that are outside.
#pragma once

#include "mortise/parts/distance_grid.hpp"
#include "mortise/parts/triangle_mesh.hpp"

namespace mortise {

/// Triangles of the zero level by surface nets (S. F. F. Gibson, MICCAI 1998): one vertex in each
/// cell that the surface passes, at the mean of where it cuts the cell's edges. Values need not be
/// distances: nodes with values <= 0 are inside, and edges are cut by linear interpolation. Normals
/// point outwards; the surface is closed, since what is inside at the grid's border is cut off
/// there as if a cell farther out were outside.
/// @throws InputError unless there is a value for each node
[[nodiscard]] TriangleMesh surface_net(const DistanceGrid& grid);

}  // namespace mortise
