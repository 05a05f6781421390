// SPDX-License-Identifier: GPL-3.0-or-later
// Inner balls about the cells of an octree.

#include "parts/inner_balls.hpp"

namespace mortise::parts {
namespace {

struct Octree {
  const NodeField& field;
  std::vector<GridBall> balls;

  // A lower bound on the depth at the corner where eight cells meet, the first of them `node`: the
  // depth changes by no more than the way.
  [[nodiscard]] double depth_at_corner(const Eigen::Array3i& node) const {
    double depth = -std::numeric_limits<double>::infinity();
    for (int corner = 0; corner < 8; ++corner) {
      const Eigen::Array3i at = node + Eigen::Array3i(corner & 1, corner >> 1 & 1, corner >> 2 & 1);
      if ((at < field.size).all())
        depth = std::max<double>(depth, field.depth[field.index(at.x(), at.y(), at.z())]);
    }
    return depth - kHalfDiagonal;
  }

  // The cube of `edge` cells whose lowest one is `node`.
  void visit(const Eigen::Array3i& node, int edge) {
    if ((node >= field.size).any()) return;
    if (edge == 1) {
      const float depth = field.depth[field.index(node.x(), node.y(), node.z())];
      if (depth > 0.0F)
        balls.push_back({node.cast<double>(), std::min<double>(depth, kHalfDiagonal)});
      return;
    }
    const int half = edge / 2;
    const double depth =
        (node + half - 1 < field.size).all() ? depth_at_corner(node + half - 1) : -1.0;
    if (depth >= edge * kHalfDiagonal) {
      balls.push_back({node.cast<double>() + (half - 0.5), edge * kHalfDiagonal});
      return;
    }
    for (int child = 0; child < 8; ++child)
      visit(node + half * Eigen::Array3i(child & 1, child >> 1 & 1, child >> 2 & 1), half);
  }
};

}  // namespace

std::vector<GridBall> octree_balls(const NodeField& field) {
  int edge = 1;
  while ((field.size > edge).any()) edge *= 2;
  Octree tree{field, {}};
  tree.visit({0, 0, 0}, edge);
  return std::move(tree.balls);
}

}  // namespace mortise::parts
