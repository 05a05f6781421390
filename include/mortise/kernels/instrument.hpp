// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Instrument kernels: periodic, band-limited stand-ins for a Dirac delta, one axis of a product.
#pragma once

#include <Eigen/Core>

namespace mortise {

/// One axis of a separable instrument function [FC, Eq. 27]:
///
///   k(x) = 1/L (c_0 + 2 sum_{j=1..n} c_j cos(2 pi j x / L)),   c_0 = 1, so that its integral is 1.
///
/// Multiplying a spectrum with prod_axes c_|j| at the frequencies j / L convolves with prod k.
struct InstrumentKernel {
  double period = 1.0;           ///< L, length unit of the bodies; > 0
  Eigen::VectorXd coefficients;  ///< n + 1: c_0 ... c_n, dimensionless; c_0 = 1

  [[nodiscard]] Eigen::Index degree() const noexcept { return coefficients.size() - 1; }
  /// k(x), one over the length unit.
  [[nodiscard]] double operator()(double x) const;
  /// The integral of k from 0 to x: W of [FC, Sec. 6.1], in closed form.
  [[nodiscard]] double antiderivative(double x) const;
  /// The integral of |k| over [from, to]; sign changes are bracketed on 32 samples per mode and
  /// bisected.
  [[nodiscard]] double absolute_mass(double from, double to) const;
};

/// Windows of the coefficients. Fejer's kernel is non-negative everywhere; Blackman's has side
/// lobes of 1e-3 of its peak, Hann's of 1e-2.
enum class InstrumentWindow { kFejer, kHann, kBlackman };

/// @param degree  n >= 1, the highest mode
/// @throws InputError if an argument is out of range
[[nodiscard]] InstrumentKernel window_kernel(InstrumentWindow window, int degree, double period);

/// The equiripple kernel of Parks and McClellan [FC, Sec. 5.4]: among all even trigonometric
/// polynomials of this degree the one whose largest deviation from 1 on |x| <= pass and from 0 on
/// stop <= |x| <= L / 2, the latter times `stop_weight`, is least; then scaled to c_0 = 1.
///
/// @param pass, stop   0 <= pass < stop < period / 2
/// @param stop_weight  > 0
/// @throws InputError if an argument is out of range or the exchange does not converge
[[nodiscard]] InstrumentKernel parks_mcclellan_kernel(int degree, double period, double pass,
                                                      double stop, double stop_weight = 1.0);

/// Adds the least constant that makes the kernel non-negative everywhere, then scales to c_0 = 1.
[[nodiscard]] InstrumentKernel lifted_to_nonnegative(const InstrumentKernel& kernel);

/// The square of a kernel scaled to c_0 = 1: twice the degree, non-negative.
[[nodiscard]] InstrumentKernel squared(const InstrumentKernel& kernel);

}  // namespace mortise
