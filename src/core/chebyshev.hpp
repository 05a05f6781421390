// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Chebyshev series of fixed length; Boost.Math's clenshaw sums them.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

namespace mortise {

/// Zero i of T_n, -1 < z < 1.
inline double chebyshev_zero(int i, int n) { return std::cos(std::numbers::pi * (i + 0.5) / n); }

/// The first `terms` coefficients c of f(z) = c_0 / 2 + sum_k c_k T_k(z), from f at the zeros of
/// T_n, n the number of samples.
inline std::vector<double> chebyshev_series(const std::vector<double>& samples, int terms) {
  const int n = static_cast<int>(samples.size());
  std::vector<double> series(static_cast<std::size_t>(terms), 0.0);
  for (int k = 0; k < terms; ++k) {
    double c = 0.0;
    for (int i = 0; i < n; ++i) c += samples[i] * std::cos(std::numbers::pi * k * (i + 0.5) / n);
    series[k] = c * (2.0 / n);
  }
  return series;
}

}  // namespace mortise
