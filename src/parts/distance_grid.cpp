// SPDX-License-Identifier: GPL-3.0-or-later
// Distances on a grid, block by block along a path of neighbours.
#include "mortise/parts/distance_grid.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "mortise/core/errors.hpp"
#include "mortise/core/threads.hpp"
#include "parts/grid_blocks.hpp"

namespace mortise {
namespace {

GridNodes around(const char* where, const Eigen::AlignedBox3d& box, int nodes, double margin,
                 bool cubic) {
  if (box.isEmpty() || !box.min().allFinite() || !box.max().allFinite())
    throw InputError(std::string(where) + ": a box that is finite and not empty expected");
  if (!(nodes >= 2))
    throw InputError(std::string(where) + ": nodes must be >= 2, got " + std::to_string(nodes));
  if (!(margin >= 0.0) || !std::isfinite(margin))
    throw InputError(std::string(where) + ": margin must be >= 0, got " + std::to_string(margin));
  const Eigen::Vector3d sides = box.sizes().array() + 2.0 * margin;
  GridNodes grid;
  grid.spacing = sides.maxCoeff() / (nodes - 1);
  if (!(grid.spacing > 0.0)) throw InputError(std::string(where) + ": the box has no extent");
  for (int d = 0; d < 3; ++d)
    grid.size[d] =
        cubic ? nodes : 1 + static_cast<int>(std::ceil(sides[d] / grid.spacing * (1.0 - 1e-12)));
  grid.origin = box.center() - 0.5 * grid.spacing * (grid.size - 1).matrix().cast<double>();
  return grid;
}

}  // namespace

GridNodes grid_around(const Eigen::AlignedBox3d& box, int nodes, double margin) {
  return around("grid_around", box, nodes, margin, false);
}

GridNodes cubic_grid_around(const Eigen::AlignedBox3d& box, int nodes, double margin) {
  return around("cubic_grid_around", box, nodes, margin, true);
}

void check_nodes(const char* where, const GridNodes& nodes) {
  if (!(nodes.size > 0).all())
    throw InputError(std::string(where) + ": a grid of at least one node expected, got " +
                     std::to_string(nodes.size[0]) + " x " + std::to_string(nodes.size[1]) + " x " +
                     std::to_string(nodes.size[2]));
  if (!(nodes.spacing > 0.0) || !std::isfinite(nodes.spacing) || !nodes.origin.allFinite())
    throw InputError(std::string(where) + ": a finite grid of spacing > 0 expected, got " +
                     std::to_string(nodes.spacing));
}

GridBlocks::GridBlocks(const GridNodes& nodes)
    : nodes_(nodes), blocks_((nodes.size + kSide - 1) / kSide) {}

GridBlock GridBlocks::block(std::size_t index) const {
  const auto rest = static_cast<Eigen::Index>(index);
  const Eigen::Array3i first =
      kSide * Eigen::Array3i(static_cast<int>(rest / (blocks_[1] * Eigen::Index{blocks_[2]})),
                             static_cast<int>(rest / blocks_[2] % blocks_[1]),
                             static_cast<int>(rest % blocks_[2]));
  const Eigen::Array3i sizes = (nodes_.size - first).min(kSide);
  GridBlock block;
  block.points.resize(3, sizes.prod());
  block.indices.resize(static_cast<std::size_t>(sizes.prod()));
  Eigen::Index n = 0;
  for (int i = 0; i < sizes[0]; ++i)
    for (int jj = 0; jj < sizes[1]; ++jj)
      for (int kk = 0; kk < sizes[2]; ++kk, ++n) {
        // To and fro, so that each node is next to the one before.
        const int j = i % 2 == 0 ? jj : sizes[1] - 1 - jj;
        const int k = (i * sizes[1] + jj) % 2 == 0 ? kk : sizes[2] - 1 - kk;
        block.points.col(n) = nodes_.node(first[0] + i, first[1] + j, first[2] + k);
        block.indices[static_cast<std::size_t>(n)] =
            nodes_.index(first[0] + i, first[1] + j, first[2] + k);
      }
  return block;
}

DistanceGrid distance_grid(const Solid& solid, const GridNodes& nodes,
                           const DistanceGridOptions& options) {
  check_nodes("distance_grid", nodes);
  if (!(options.band > 0.0))
    throw InputError("distance_grid: band must be > 0, got " + std::to_string(options.band));
  DistanceGrid grid;
  static_cast<GridNodes&>(grid) = nodes;
  grid.values.resize(static_cast<std::size_t>(nodes.count()));
  const GridBlocks blocks(nodes);
  parallel_for(blocks.count(), options.threads, [&](std::size_t index, int) {
    const GridBlock block = blocks.block(index);
    const Eigen::VectorXd distances = solid.signed_distance(block.points, options.band);
    for (std::size_t n = 0; n < block.indices.size(); ++n)
      grid.values[static_cast<std::size_t>(block.indices[n])] =
          static_cast<float>(distances[static_cast<Eigen::Index>(n)]);
  });
  return grid;
}

}  // namespace mortise
