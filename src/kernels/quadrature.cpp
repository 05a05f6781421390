// SPDX-License-Identifier: GPL-3.0-or-later
// Gauss-Legendre nodes by Newton's method on the Legendre recurrence.
#include "kernels/quadrature.hpp"

#include <cmath>
#include <numbers>

namespace mortise {

QuadratureRule gauss_legendre(int count, double low, double high) {
  QuadratureRule rule{Eigen::VectorXd(count), Eigen::VectorXd(count)};
  for (int i = 0; i < count; ++i) {
    double x = -std::cos(std::numbers::pi * (i + 0.75) / (count + 0.5)), slope = 1.0;
    for (int step = 0; step < 8; ++step) {
      double before = 1.0, here = x;
      for (int n = 2; n <= count; ++n) {
        const double next = ((2 * n - 1) * x * here - (n - 1) * before) / n;
        before = here;
        here = next;
      }
      if (count == 1) before = 1.0;
      slope = count * (before - x * here) / (1.0 - x * x);
      x -= here / slope;
    }
    rule.nodes[i] = 0.5 * (low + high) + 0.5 * (high - low) * x;
    rule.weights[i] = 1.0 / ((1.0 - x * x) * slope * slope);
  }
  return rule;
}

}  // namespace mortise
