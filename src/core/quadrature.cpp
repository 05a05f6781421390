// SPDX-License-Identifier: GPL-3.0-or-later
// Gauss-Legendre nodes by Boost.Math: its fixed rules know their number of nodes at compile time,
// so they are made from the zeros of the polynomials here.
#include "core/quadrature.hpp"

#include <boost/math/special_functions/legendre.hpp>
#include <vector>

namespace mortise {

QuadratureRule gauss_legendre(int count, double low, double high) {
  const std::vector<double> zeros = boost::math::legendre_p_zeros<double>(count);  // those >= 0
  QuadratureRule rule{Eigen::VectorXd(count), Eigen::VectorXd(count)};
  const auto half = static_cast<Eigen::Index>(zeros.size());
  for (Eigen::Index z = 0; z < half; ++z) {
    const double x = zeros[z], slope = boost::math::legendre_p_prime(count, x);
    const double weight = 1.0 / ((1.0 - x * x) * slope * slope);
    const Eigen::Index above = count - half + z, below = half - 1 - z;
    rule.nodes[above] = 0.5 * (low + high) + 0.5 * (high - low) * x;
    rule.nodes[below] = 0.5 * (low + high) - 0.5 * (high - low) * x;
    rule.weights[above] = rule.weights[below] = weight;
  }
  return rule;
}

}  // namespace mortise
