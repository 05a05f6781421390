// SPDX-License-Identifier: GPL-3.0-or-later
// The first step of a decomposition: balls inside the solid that hold every node inside it.
#pragma once

#include <vector>

#include "parts/node_field.hpp"

namespace mortise::parts {

// Nodes on the medial axis first [SD, Alg. 1, step 1].
std::vector<GridBall> skeletal_balls(const NodeField& field, double protrusion);

// The largest ball that overlaps none before it, again and again (W&Z).
std::vector<GridBall> packed_balls(const NodeField& field);

// Balls about the cells of an octree over the grid, as large as the solid lets them be.
std::vector<GridBall> octree_balls(const NodeField& field);

}  // namespace mortise::parts
