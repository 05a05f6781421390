// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Singular value decomposition of matrices whose singular values fall fast.
#pragma once

#include <Eigen/Core>

namespace mortise {

/// m = u diag(sigma) v^T
struct ThinSvd {
  Eigen::MatrixXd u;      ///< rows x rank, orthonormal columns
  Eigen::VectorXd sigma;  ///< largest first
  Eigen::MatrixXd v;      ///< columns x rank, orthonormal columns
};

/// Singular values below the rounding of the largest are left out; at least one stays.
[[nodiscard]] ThinSvd thin_svd(const Eigen::MatrixXd& m);

}  // namespace mortise
