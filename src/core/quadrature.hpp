// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Gauss-Legendre rules.
#pragma once

#include <Eigen/Core>

namespace mortise {

/// Nodes in (low, high), increasing, and weights that sum to 1 (so that an empty interval is a rule
/// too).
struct QuadratureRule {
  Eigen::VectorXd nodes, weights;
};
[[nodiscard]] QuadratureRule gauss_legendre(int count, double low, double high);

}  // namespace mortise
