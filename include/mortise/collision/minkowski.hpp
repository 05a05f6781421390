// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Minkowski sums and obstacles of unions of balls: again unions of balls.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace mortise {

/// Balls, 4 x N: centre x, y, z and radius. Single precision: centres and radii are rounded to 6e-8
/// of the largest coordinate, a body's bounds should be near the origin.
using Balls = Eigen::Matrix4Xf;

struct MinkowskiOptions {
  double offset = 0.0;  ///< added to every radius of the result, length unit: the slice r = -offset
                        ///< of the lifted set [SD, Sec. 3.1]; may be negative
  int threads = 0;      ///< 0 = all cores; never changes the result
};

/// The sum of two unions of balls: all pairs (a_i + b_j, r_i + s_j + offset) [SD, Eq. 32-41].
///
/// The lifted form of the sum is the sum of 4D knots; equal radii are its case of one radius. With
/// a negative offset, balls whose radius would not be positive are left out.
/// @param a, b  4 x N and 4 x M, centres and radii; radii >= 0
/// @return      4 x (N M), pair (i, j) at i M + j if none is left out
/// @throws InputError if something is not finite, a radius negative, or there are more than 2^31
/// pairs Time and memory: one write of 16 N M bytes.
[[nodiscard]] Balls minkowski_sum(const Eigen::Matrix4Xd& a, const Eigen::Matrix4Xd& b,
                                  const MinkowskiOptions& options = {});

/// The translations t at which the moving body, turned by `rotation` and then moved by t, meets the
/// fixed one: balls at x_i - R y_j of radius r_i + s_j + offset [SD, Eq. 38-41; Lemma 2: the moving
/// body's knots mirrored in x and in r].
[[nodiscard]] Balls translational_obstacle(const Eigen::Matrix4Xd& fixed,
                                           const Eigen::Matrix4Xd& moving,
                                           const Eigen::Quaterniond& rotation,
                                           const MinkowskiOptions& options = {});

/// The balls without those that lie inside another one: the same union with fewer of them.
///
/// Every ball dropped lies in one that stays; nearly all that lie in another are dropped. Depths
/// are propagated over a grid, whose steps make a ball's reach look up to 10% shorter, so some
/// redundant ones stay. Order is kept.
/// @param cells  grid cells along the longest side of the bounding box, 2 to 512
/// @throws InputError if something is not finite, a radius negative or cells out of range
/// Time O(N + cells^3).
[[nodiscard]] Balls without_contained(const Balls& balls, int cells = 96);

}  // namespace mortise
