// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Small symmetric systems, by one instance of Eigen's solver: another for each size takes a
/// compiler two seconds.
#pragma once

#include <Eigen/Core>

namespace mortise::detail {

/// x of A x = b for a symmetric A without negative eigenvalues, by L D L^T with pivots.
[[nodiscard]] Eigen::VectorXd solve_symmetric(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);

}  // namespace mortise::detail
