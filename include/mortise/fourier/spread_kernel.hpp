// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The Kaiser-Bessel kernel that carries scattered points onto a regular grid.
#pragma once

#include <span>
#include <vector>

namespace mortise {

/// phi(x) = I0(beta sqrt(1 - (2 x / width)^2)) / I0(beta) for |x| <= width / 2 cells of the grid,
/// else 0.
struct SpreadKernel {
  int width = 0;  ///< cells per axis one point touches, 2 to 16
  double beta = 0.0;
  double expected_error = 0.0;  ///< relative l2 error over all modes, points at random
  double fit_error =
      0.0;  ///< largest admissible error of the polynomial pieces, relative to phi(0)

  [[nodiscard]] double operator()(double x) const;
  /// Its Fourier transform at nu cycles per cell; mode k on a grid of N cells is nu = k / N, and is
  /// divided by this.
  [[nodiscard]] double transform(double nu) const;
};

/// The narrowest kernel with which modes[d] modes per axis, |k| <= modes[d] / 2, come from a grid
/// of size[d] cells with a relative l2 error <= tolerance, even for one point at the worst place;
/// `epsilon` is the unit roundoff of the grid's type.
/// @throws InputError if more than 16 cells would be needed or rounding alone would exceed the
/// tolerance
[[nodiscard]] SpreadKernel design_spread_kernel(double tolerance, std::span<const int> modes,
                                                std::span<const int> size, double epsilon);

/// Polynomials, highest power first, that give phi(j - width / 2 + (z + 1) / 2) at z in [-1, 1] for
/// piece j = 0 .. width - 1: coefficient of z^(degree - p) of piece j at [p * stride + j]; the
/// degree follows from fit_error.
struct KernelPieces {
  int degree = 0;
  int stride = 0;
  std::vector<double> coefficients;
};
[[nodiscard]] KernelPieces fit_pieces(const SpreadKernel& kernel, int stride);

}  // namespace mortise
