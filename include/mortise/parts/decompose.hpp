// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Spherical decomposition: few balls whose union is a solid to within half a grid cell's diagonal.
#pragma once

#include <Eigen/Core>

#include "mortise/core/knots.hpp"
#include "mortise/parts/distance_grid.hpp"
#include "mortise/parts/solid.hpp"

namespace mortise {

/// How the inner balls A1 are chosen among the largest balls about the grid's nodes.
enum class DecomposeMethod {
  kSkeletal,      ///< nodes on the medial axis first [SD, Alg. 1]
  kInnerPacking,  ///< the largest ball that overlaps none before it, again and again (W&Z)
  kOctree,        ///< the balls about the cells of an octree
};

/// Which of the expanded balls A2 are kept as A3. To any choice balls are added until all of the
/// boundary is within epsilon (Decomposition::added), among them small ones about nodes that no
/// ball of A2 reaches. Where none is added, kContainment is [SD, Alg. 1].
enum class Reduction {
  kCover,        ///< few of them that hold every node inside the solid
  kContainment,  ///< those whose inner ball is in no other kept ball [SD, Alg. 1, step 3]
  kNone,         ///< all
};

/// What the knots weigh.
enum class KnotWeights {
  kUnit,   ///< 1 each
  kShare,  ///< part of a ball's nodes that is its own; a node is shared equally by the balls that
           ///< hold it, so that weighted volumes add up to about that of the union
};

struct DecomposeOptions {
  DecomposeMethod method = DecomposeMethod::kSkeletal;
  Reduction reduction = Reduction::kCover;
  int grid = 64;             ///< nodes along the longest side of the solid's box; 2 to 1024
  double protrusion = 0.25;  ///< mu of [SD, Eq. A.1] in [0, 1]; only kSkeletal uses it
  KnotWeights weights = KnotWeights::kUnit;
  double expansion = 1.0;  ///< radii grow by this part of epsilon; in [0, 1]
  int threads = 0;         ///< 0 = all cores; never changes the result
};

struct Decomposition {
  Knots knots;              ///< A3: n3 balls in the solid's frame by decreasing radius
  Eigen::Matrix4Xd inner;   ///< A1: 4 x n1, balls inside the solid that hold every node inside it
  Eigen::Index added = 0;   ///< of the knots, those added for the boundary's sake
  double spacing = 0.0;     ///< edge of the cubic grid cells
  double epsilon = 0.0;     ///< half a cell's diagonal: bound on the Hausdorff distance
  Eigen::Index nodes = 0;   ///< nodes of the grid
  Eigen::Index inside = 0;  ///< of these inside the solid
  double coverage = 0.0;    ///< part of the nodes inside that lie in the knots; 1 if expansion is 1
  double volume = 0.0;      ///< of the solid, by its nodes
};

/// Decomposes a solid: inner balls by `method`, radii expanded, redundant balls dropped.
///
/// The union U of the knots and the solid S satisfy U in S + B(epsilon) and S in U + B(epsilon)
/// [SD, Prop. 3]: the sets are at most half the diagonal of a grid cell apart. docs/math.md has the
/// derivation and what differs from the paper.
/// @throws InputError if an option is out of range, no node lies inside the solid or the grid has
/// more than 2^28 nodes
/// Time m distances and O(sum of the inner balls' volumes / spacing^3), memory about 16 bytes a
/// node, m = nodes.
[[nodiscard]] Decomposition decompose(const Solid& solid, const DecomposeOptions& options = {});

/// The same from exact distances at the nodes of a grid, whose cells hold the solid;
/// options.grid is not used.
[[nodiscard]] Decomposition decompose(const DistanceGrid& grid,
                                      const DecomposeOptions& options = {});

}  // namespace mortise
