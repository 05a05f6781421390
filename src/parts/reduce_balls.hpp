// SPDX-License-Identifier: GPL-3.0-or-later
// The last step of a decomposition: dropping expanded balls that the others make up for.
#pragma once

#include <vector>

#include "parts/node_field.hpp"

namespace mortise::parts {

// Few of the balls that hold every node inside the solid which all of them hold, by greedy set
// cover. Returns their indices.
std::vector<std::size_t> cover_nodes(const NodeField& field, const std::vector<GridBall>& balls,
                                     int threads);

// Part of the nodes inside the solid that lie in the balls.
double covered_part(const NodeField& field, const std::vector<GridBall>& balls);

}  // namespace mortise::parts
