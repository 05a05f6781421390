// SPDX-License-Identifier: GPL-3.0-or-later
// Half-cones along the fourth axis: the paper's trimming and the fitted one; derivation in
// docs/math.md.
#include "mortise/kernels/cone.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "core/quadrature.hpp"
#include "kernels/thin_svd.hpp"
#include "mortise/core/errors.hpp"

namespace mortise {
namespace {

using std::numbers::pi;

// The trimmed cone is smooth and periodic in r, so the trapezoidal rule converges faster than any
// power.
int trapezoid_points(double k, double eta, double height) {
  return 512 + static_cast<int>(std::ceil(16.0 * height * (std::abs(k) + std::abs(eta))));
}

}  // namespace

double trimming_factor(double r, double height, double alpha) {
  return bump(1.0 - 2.0 * r / height, alpha);
}

std::complex<double> cone_transform(const RadialKernel& kernel, double k, double eta, double height,
                                    double trim_alpha) {
  if (!(height > 0.0) || !(trim_alpha > 0.0) || std::isinf(trim_alpha))
    throw InputError("cone_transform: height must be > 0 and trim_alpha > 0 and finite, got " +
                     std::to_string(height) + " and " + std::to_string(trim_alpha));
  const int points = trapezoid_points(k, eta, height);
  std::complex<double> sum = 0.0;
  for (int i = 1; i < points; ++i) {
    const double s = height * i / points;
    sum += kernel.transform(k, s) * trimming_factor(s, height, trim_alpha) *
           std::polar(1.0, 2.0 * pi * eta * s);
  }
  return sum * (height / points);
}

double ConeSeries::trim(double r) const {
  return trim_alpha_ > 0.0 ? trimming_factor(r, period_, trim_alpha_) : 1.0;
}

Eigen::VectorXcd ConeSeries::coefficients(double k) const {
  Eigen::VectorXd samples(radii_.size());
  for (Eigen::Index j = 0; j < samples.size(); ++j) samples[j] = transform_(k, radii_[j]);
  const Eigen::VectorXcd factors = from_samples_ * samples;
  return to_modes_ * factors;
}

ConeSeries trimmed_cone(const RadialKernel& kernel, double height, double trim_alpha, int modes) {
  if (!(height > 0.0) || !(trim_alpha > 0.0) || std::isinf(trim_alpha) || modes < 1)
    throw InputError("trimmed_cone: height and trim_alpha must be > 0 and finite, modes >= 1");
  ConeSeries series(transform_of(kernel));
  series.period_ = height;
  series.trim_alpha_ = trim_alpha;
  const int points = 512 + 8 * modes;
  series.radii_.resize(points - 1);
  series.from_samples_.resize(modes, points - 1);
  series.to_modes_ = Eigen::MatrixXcd::Identity(modes, modes);
  for (int i = 1; i < points; ++i) {
    const double s = height * i / points;
    series.radii_[i - 1] = s;
    for (int m = 0; m < modes; ++m)
      series.from_samples_(m, i - 1) = std::polar(trimming_factor(s, height, trim_alpha) / points,
                                                  2.0 * pi * (m - modes / 2) * i / points);
  }
  return series;
}

ConeSeries fitted_cone(const RadialTransform& transform, double k_max, double r_min, double r_max,
                       double tolerance) {
  if (!(k_max > 0.0 && std::isfinite(k_max)) ||
      !(r_min > 0.0 && r_min <= r_max && std::isfinite(r_max)))
    throw InputError("fitted_cone: expected 0 < k_max and 0 < r_min <= r_max, got " +
                     std::to_string(k_max) + ", " + std::to_string(r_min) + " and " +
                     std::to_string(r_max));
  if (!(tolerance >= 1e-10 && tolerance <= 0.1))
    throw InputError("fitted_cone: tolerance must be in [1e-10, 0.1], got " +
                     std::to_string(tolerance));
  // A Fourier extension: as the series only has to hold on a part of its period it converges
  // geometrically although phi^ is not periodic; the coefficients are the least-squares solution
  // with the smallest norm.
  const int kMostModes = 100 + static_cast<int>(20.0 * k_max * r_max);
  const double width = std::max(r_max - r_min, 1e-3 * r_max);
  ConeSeries series(transform);
  series.period_ = 2.5 * width;
  const int k_count = 9 + static_cast<int>(4.0 * k_max * r_max);
  double largest = 0.0;
  for (int i = 0; i < k_count; ++i)
    largest = std::max(largest, std::abs(transform(k_max * i / (k_count - 1), r_max)));
  for (int modes = 4;; modes += 2) {
    if (modes > kMostModes)
      throw InputError("fitted_cone: the tolerance is out of reach of double precision");
    const QuadratureRule rule = gauss_legendre(2 * modes + 8, r_max - width, r_max);
    const Eigen::VectorXd row_scale = rule.weights.cwiseSqrt();
    // The basis A + i B as the real matrix [A -B; B A]: its singular values are those of A + i B,
    // each twice.
    const Eigen::Index nodes = rule.nodes.size();
    Eigen::MatrixXd basis(2 * nodes, 2 * modes);
    for (Eigen::Index j = 0; j < nodes; ++j)
      for (int m = 0; m < modes; ++m) {
        const std::complex<double> value =
            std::polar(row_scale[j], -2.0 * pi * (m - modes / 2) * rule.nodes[j] / series.period_);
        basis(j, m) = basis(nodes + j, modes + m) = value.real();
        basis(nodes + j, m) = value.imag();
        basis(j, modes + m) = -value.imag();
      }
    const ThinSvd svd = thin_svd(basis);
    // Smaller singular values are rounding.
    const double least = 1e-14 * svd.sigma[0];
    const Eigen::VectorXd inverse =
        svd.sigma.unaryExpr([&](double s) { return s > least ? 1.0 / s : 0.0; });
    series.radii_ = rule.nodes;
    // Samples are real, so the upper half of U says what they hold, and the two halves of V are the
    // modes' real and imaginary parts. In two factors: their product would carry rounding from the
    // smallest singular values into all directions.
    series.from_samples_ = svd.u.topRows(nodes).transpose() * row_scale.asDiagonal();
    series.to_modes_.resize(modes, inverse.size());
    series.to_modes_.real() = svd.v.topRows(modes) * inverse.asDiagonal();
    series.to_modes_.imag() = svd.v.bottomRows(modes) * inverse.asDiagonal();
    double worst = 0.0;
    const int r_count = 4 * modes;
    for (int i = 0; i < k_count; ++i) {
      const double k = k_max * i / (k_count - 1);
      const Eigen::VectorXcd g = series.coefficients(k);
      for (int j = 0; j <= r_count; ++j) {
        const double r = r_min + (r_max - r_min) * j / r_count;
        std::complex<double> value = 0.0;
        for (int m = 0; m < modes; ++m)
          value += g[m] * std::polar(1.0, -2.0 * pi * (m - modes / 2) * r / series.period_);
        worst = std::max(worst, std::abs(value - transform(k, r)) / largest);
      }
    }
    if (worst <= tolerance) return series;
  }
}

}  // namespace mortise
