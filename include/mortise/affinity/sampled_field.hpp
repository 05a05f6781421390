// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Channels of fields that are given by their values at the nodes of a grid.
#pragma once

#include <Eigen/Core>
#include <string>

#include "mortise/affinity/channel.hpp"

namespace mortise {

/// Width of the Gaussian that a node stands for: its standard deviation in grid steps.
inline constexpr double kNodeWidth = 0.5;

/// A channel of two sampled fields, f(x) = sum_i c_i G(x - x_i): each node is a knot, and its
/// kernel is a Gaussian of standard deviation kNodeWidth * spacing and integral spacing^3, so that
/// the sum is the field, smoothed. Being knots, the nodes rotate exactly: nothing is interpolated,
/// in space or in the spectrum. What the sampling itself leaves out: docs/math.md.
///
/// @param fixed, moving  node positions (input frames) and complex field values; radii are set here
/// @param spacing        of the nodes, length unit; > 0
/// @throws InputError if a set is bad or the spacing out of range
[[nodiscard]] Channel sampled_channel(const std::string& name, double weight, const Knots& fixed,
                                      const Knots& moving, double spacing);

struct SampledSkinOptions {
  double spacing = 1.0;  ///< of the nodes, length unit; > 0
  double offset = 1.0;   ///< r0, thickness of the skin, length unit; > 0
  double penalty = 3.0;  ///< lambda, what the core weighs against the skin; > 1
  double feature = 0.0;  ///< exponent by which hollows' skin and tips' core outweigh flat ones';
                         ///< >= 0, 0 = all alike
  double feature_radius = 3.0;  ///< of the ball that tells hollows from tips, length unit; > 0
};

/// The double-skin affinity i (f_{S+B0} - lambda f_S) [SD, Eq. 51] of a solid whose signed distance
/// is known at grid nodes. f_S and f_{S+B0} are the shares of a node's cell with d < 0 and d < r0,
/// as if the boundary were flat across the cell. Nodes where both are 0 are left out.
///
/// With options.feature = p the skin counts (v / v0)^p and the core ((1 - v) / v0)^p as much, v the
/// share of a ball around the node that the solid fills and v0 what a flat boundary at this
/// distance would: 1 along flat faces, more in hollows and in tips, less the other way round. So a
/// tip in a hollow outweighs two faces laid on each other, at no cost to the search (docs/math.md).
/// @param nodes     3 x N, input frame, on a lattice of the spacing; all nodes inside are given
/// @param distance  N, negative inside
/// @throws InputError if sizes differ, an option is out of range or no node is inside
[[nodiscard]] Knots sample_double_skin(const Eigen::Matrix3Xd& nodes,
                                       const Eigen::VectorXd& distance,
                                       const SampledSkinOptions& options = {});

}  // namespace mortise
