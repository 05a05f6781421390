// SPDX-License-Identifier: GPL-3.0-or-later
// The least of many functions at the nodes of a grid, worked out where it is near zero.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <vector>

#include "mortise/parts/distance_grid.hpp"

namespace mortise::parts {

// f_i(at) of each i asked for, into `values`; called from any thread.
using Functions = std::function<void(const std::vector<std::int32_t>& which,
                                     const Eigen::Vector3d& at, std::vector<double>& values)>;

// min_i f_i(x) at the nodes of a grid, each f_i changing no faster than x moves. Values are exact
// where they are within a node's spacing of zero, so that every edge of the grid that the zero
// level crosses has both ends exact; elsewhere they have the right sign and at least that size.
//
// Boxes of nodes are halved. In one of half diagonal rho about q only those i can be the least
// that come within 2 rho of the least at q, and where |min_i f_i(q)| > rho + spacing nothing is to
// be done. Time about O(count) a few times, and the boxes that the level passes.
DistanceGrid envelope_grid(const GridNodes& nodes, std::int32_t count, int threads,
                           const Functions& functions);

}  // namespace mortise::parts
