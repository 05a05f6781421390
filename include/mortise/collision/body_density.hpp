// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What the gap function is made from: one body's density as weighted points with a radial kernel.
#pragma once

#include <Eigen/Core>
#include <array>
#include <complex>
#include <span>

#include "mortise/core/knots.hpp"
#include "mortise/kernels/bump.hpp"

namespace mortise {

/// rho(x) = sum_i (a_i + i b_i) phi(x - x_i; r_i): balls or bumps of knots, or samples of a grid.
///
/// Real and imaginary part are two real densities, so that Re Int rho_1 rho_2 = Int a_1 a_2 - Int
/// b_1 b_2 [HA, Eq. 7].
struct BodyDensity {
  Eigen::Matrix3Xd points;   ///< 3 x N, the body's own frame and length unit
  Eigen::VectorXd radii;     ///< N, > 0; or none: points without extent, weights are integrals
  Eigen::VectorXcd weights;  ///< N; with radii dimensionless, else volumes
  RadialKernel kernel;       ///< phi; not used without radii

  [[nodiscard]] Eigen::Index size() const noexcept { return points.cols(); }
  [[nodiscard]] bool is_real() const { return (weights.imag().array() == 0.0).all(); }
};

/// The knots' balls, every radius grown by `offset` (may be negative as long as a ball is left;
/// smaller ones are dropped).
/// @throws InputError on bad knots or if no ball is left
[[nodiscard]] BodyDensity density_of_knots(const Knots& knots,
                                           const RadialKernel& kernel = RadialKernel{},
                                           double offset = 0.0);

/// Samples on a regular grid, value (i, j, k) at origin + spacing (i, j, k), last index fastest;
/// each stands for the integral over its cell. Zeros are left out.
/// @throws InputError if counts differ, spacing is not > 0 or there is nothing but zeros
[[nodiscard]] BodyDensity density_of_samples(std::span<const std::complex<float>> values,
                                             const std::array<int, 3>& size,
                                             const Eigen::Vector3d& origin, double spacing);

/// A ball that holds the density: points with their radii.
struct BoundingBall {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double radius = 0.0;
};
[[nodiscard]] BoundingBall bounding_ball(const BodyDensity& density);

/// rho^(w) of the density moved by -centre, at w = k / box, k from -floor(n / 2) on each of three
/// axes, axis 0 slowest. Column 0: of the real part; column 1, if the density is not real: of the
/// imaginary part.  Relative l2 error <= tolerance.
[[nodiscard]] Eigen::MatrixXcd density_spectrum(const BodyDensity& density,
                                                const Eigen::Vector3d& centre, int modes,
                                                double box, double tolerance, int threads = 0);

/// rho^(w) and its gradient but for the radial part, term by term: columns are sum_i c_i phi^(|w|;
/// r_i) e_i (1, -2 pi i y_x, -2 pi i y_y, -2 pi i y_z), y = x_i - centre, e_i = exp(-2 pi i w.y),
/// for the real part and then, if the density is not real, the imaginary one. Rows are frequencies.
/// @param frequencies  3 x M, cycles per length unit
[[nodiscard]] Eigen::MatrixXcd density_spectrum_at(const BodyDensity& density,
                                                   const Eigen::Vector3d& centre,
                                                   const Eigen::Matrix3Xd& frequencies,
                                                   int threads = 0);

}  // namespace mortise
