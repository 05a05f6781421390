// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The Fourier sum over scattered points exactly as it is written, one exponential per point and
/// mode.
#pragma once

#include <Eigen/Core>
#include <array>
#include <complex>
#include <numbers>

namespace mortise::reference {

/// f^(k) = sum_i c_i exp(-2 pi i k.x_i / L), k from -floor(n / 2) on each axis, axis 0 slowest.
template <int D>
Eigen::VectorXcd ndft(const Eigen::Matrix<double, D, Eigen::Dynamic>& points,
                      const Eigen::VectorXcd& weights, const std::array<int, D>& modes,
                      const std::array<double, D>& box) {
  Eigen::Index total = 1;
  for (const int n : modes) total *= n;
  Eigen::VectorXcd result = Eigen::VectorXcd::Zero(total);
  for (Eigen::Index index = 0; index < total; ++index) {
    Eigen::Matrix<double, D, 1> frequency;
    Eigen::Index rest = index;
    for (int d = D - 1; d >= 0; --d) {
      frequency[d] = static_cast<double>(rest % modes[d] - modes[d] / 2) / box[d];
      rest /= modes[d];
    }
    for (Eigen::Index i = 0; i < points.cols(); ++i)
      result[index] +=
          weights[i] * std::polar(1.0, -2.0 * std::numbers::pi * frequency.dot(points.col(i)));
  }
  return result;
}

}  // namespace mortise::reference
