// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The bump psi_alpha and the radial kernels made from it, with their Fourier transforms.
#pragma once

#include <limits>
#include <vector>

#include "mortise/kernels/radial_transform.hpp"

namespace mortise {

/// psi_alpha(x) = exp(1 / (1 - |x|^-alpha)) for |x| < 1, else 0 [SD, Eq. 10]; alpha > 0, infinity
/// gives the indicator of |x| < 1.
[[nodiscard]] double bump(double x, double alpha);

/// phi(x; r) = psi_alpha(|x| / r) and its transform phi^(k; r), k = |w| in cycles per length unit.
///
/// One function of one variable holds them all: phi^(k; r) = r^3 Psi(k r). For balls (alpha
/// infinite) it is in closed form, otherwise by quadrature, tabulated up to k r = 16: error below
/// 1e-12 of the kernel's volume phi^(0; r).
class RadialKernel {
 public:
  /// @throws InputError unless alpha > 0.  Time about 15 ms for finite alpha.
  explicit RadialKernel(double alpha = std::numeric_limits<double>::infinity());

  [[nodiscard]] double alpha() const noexcept { return alpha_; }
  [[nodiscard]] double value(double distance, double r) const { return bump(distance / r, alpha_); }
  /// Odd in r: for r < 0 the analytic continuation -phi^(k; -r).
  [[nodiscard]] double transform(double k, double r) const;
  /// phi^(0; r).
  [[nodiscard]] double volume(double r) const { return transform(0.0, r); }

 private:
  [[nodiscard]] double unit_transform(double u) const;  // Psi

  double alpha_;
  std::vector<double> table_;  // Chebyshev coefficients of Psi, piece by piece; empty for balls
};

/// phi^(k; r) of a kernel as a function.
[[nodiscard]] RadialTransform transform_of(const RadialKernel& kernel);

}  // namespace mortise
