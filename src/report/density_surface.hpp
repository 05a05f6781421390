// SPDX-License-Identifier: GPL-3.0-or-later
// A smooth surface around balls.
#pragma once

#include <Eigen/Core>

#include "mortise/parts/triangle_mesh.hpp"

namespace mortise::detail {

// The level 1 of sum_i exp(1.3 (1 - |x - x_i|^2 / r_i^2)), a Gaussian stand-in for the molecular
// surface (J. F. Blinn, ACM Trans. Graphics 1 (1982) 235-256), triangulated by surface nets (S. F.
// F. Gibson, MICCAI 1998) on a grid of this spacing; coarser where the grid would exceed 20 million
// points.
[[nodiscard]] TriangleMesh density_surface(const Eigen::Matrix3Xd& centres,
                                           const Eigen::VectorXd& radii, double spacing);

}  // namespace mortise::detail
