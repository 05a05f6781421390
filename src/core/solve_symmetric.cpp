// SPDX-License-Identifier: GPL-3.0-or-later
// Small symmetric systems.
#include "core/solve_symmetric.hpp"

#include <Eigen/Cholesky>

namespace mortise::detail {

Eigen::VectorXd solve_symmetric(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
  return a.ldlt().solve(b);
}

}  // namespace mortise::detail
