// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Weighted balls, the common form of molecules and parts.
#pragma once

#include <Eigen/Core>

namespace mortise {

/// Weighted balls that sample one body's shape: the 4D knots of [SD, Eq. 12].
struct Knots {
  Eigen::Matrix4Xd
      points;  ///< 4 x N: centre x, y, z and radius r > 0, in the body's own frame and length unit
  Eigen::VectorXcd weights;  ///< N: real part skin, imaginary part core; dimensionless

  [[nodiscard]] Eigen::Index size() const noexcept { return points.cols(); }
};

/// Throws InputError naming `who` unless there is at least one knot, the counts agree, all is
/// finite and all radii > 0.
void check_knots(const Knots& knots, const char* who);

}  // namespace mortise
