// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A tree of balls over balls, and the distance to their union by it.
#pragma once

#include <Eigen/Core>

namespace mortise {

struct SphereTreeOptions {
  int arity = 4;  ///< most children of a ball; 2 to 64
};

/// Balls in balls: the root first, then level by level; the leaves are the balls given. All leaves
/// are equally deep.
struct SphereTree {
  Eigen::Matrix4Xd balls;  ///< 4 x T: centre and radius
  Eigen::VectorXi
      first_child;           ///< T: index of the first child, the others follow it; -1 for a leaf
  Eigen::VectorXi children;  ///< T: how many; 0 for a leaf
  Eigen::VectorXi leaf;      ///< T: which of the balls given a leaf is; -1 above the leaves

  [[nodiscard]] Eigen::Index size() const noexcept { return balls.cols(); }
};

/// Builds the tree bottom-up: near balls are grouped, each group gets its smallest enclosing ball,
/// and these are grouped again until one is left. Every child lies inside its parent, exactly as
/// computed in doubles: |x_child - x_parent| + r_child <= r_parent.
/// @param balls  4 x N, N >= 1: centre and radius >= 0
/// @throws InputError if there is no ball, a number is not finite, a radius < 0 or arity out of
/// range
/// Time O(N log N).
[[nodiscard]] SphereTree sphere_tree(const Eigen::Matrix4Xd& balls,
                                     const SphereTreeOptions& options = {});

/// Throws InputError naming `who` unless the tree is one: a root, every other ball the child of one
/// ball before it that holds it, the leaves 0 to `leaves` - 1 each once.
void check_sphere_tree(const SphereTree& tree, Eigen::Index leaves, const char* who);

/// min_k |p - x_k| - r_k over the leaves at each point p: outside the union of the balls the
/// distance to it, inside minus the depth in the deepest ball.
/// @param points  3 x N
[[nodiscard]] Eigen::VectorXd distance_to_union(const SphereTree& tree,
                                                const Eigen::Matrix3Xd& points, int threads = 0);

}  // namespace mortise
