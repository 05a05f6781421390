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

// For each ball the mean over its nodes of one over the number of balls that hold the node.
std::vector<double> shares(const NodeField& field, const std::vector<GridBall>& balls);

// Part of the nodes inside the solid that lie in the balls.
double covered_part(const NodeField& field, const std::vector<GridBall>& balls);

}  // namespace mortise::parts
