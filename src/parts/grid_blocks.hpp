// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A grid cut into blocks of neighbouring nodes, the pieces that threads work on.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "mortise/parts/distance_grid.hpp"

namespace mortise {

/// @throws InputError if the grid has no node or is not finite
void check_nodes(const char* where, const GridNodes& nodes);

/// Nodes of one block in an order in which each is next to the one before.
struct GridBlock {
  Eigen::Matrix3Xd points;
  std::vector<Eigen::Index> indices;  ///< where their values belong
};

class GridBlocks {
 public:
  explicit GridBlocks(const GridNodes& nodes);

  [[nodiscard]] std::size_t count() const noexcept {
    return static_cast<std::size_t>(blocks_[0]) * blocks_[1] * blocks_[2];
  }
  [[nodiscard]] GridBlock block(std::size_t index) const;

 private:
  static constexpr int kSide = 6;  ///< 216 nodes: one chunk of MeshSolid's
  GridNodes nodes_;
  Eigen::Array3i blocks_;
};

}  // namespace mortise
