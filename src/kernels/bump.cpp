// SPDX-License-Identifier: GPL-3.0-or-later
// Bump kernels and their transforms.
#include "mortise/kernels/bump.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "mortise/core/errors.hpp"
#include "mortise/kernels/ball.hpp"

namespace mortise {
namespace {

using std::numbers::pi;

// Psi is of exponential type 2 pi, so on a piece of half width 1/8 its Chebyshev series falls like
// (pi / 8)^n / n!: below 1e-13 from n = 12 on.
constexpr double kLast = 16.0, kPiece = 0.25;
constexpr int kTerms = 12, kPieces = 64;

// psi_alpha from 1 - x, which keeps its digits where alpha is large and all happens near x = 1.
double bump_below_one(double one_minus_x, double alpha) {
  const double p = std::exp(alpha * std::log1p(-one_minus_x));  // x^alpha
  return p >= 1.0 ? 0.0 : std::exp(-p / (1.0 - p));
}

// Psi(u) = 4 pi Int_0^1 s^2 psi(s) sinc(2 u s) ds by the double exponential rule, which does not
// mind what psi does at either end. The step resolves the oscillation of the middle.
double psi_by_quadrature(double u, double alpha) {
  const double h = std::min(1.0 / 48.0, 1.0 / (8.0 * u + 1.0));
  const int steps = static_cast<int>(std::ceil(3.4 / h));
  double sum = 0.0;
  for (int i = -steps; i <= steps; ++i) {
    const double t = i * h, e = std::exp(-pi * std::sinh(t));
    const double s = 1.0 / (1.0 + e), one_minus_s = e / (1.0 + e);
    const double weight = pi * std::cosh(t) * s * one_minus_s;
    const double v = 2.0 * pi * u * s;
    sum += weight * s * s * bump_below_one(one_minus_s, alpha) * (v < 1e-9 ? 1.0 : std::sin(v) / v);
  }
  return 4.0 * pi * h * sum;
}

}  // namespace

double bump(double x, double alpha) {
  const double a = std::abs(x);
  if (!(a < 1.0)) return 0.0;
  return std::isinf(alpha) ? 1.0 : bump_below_one(1.0 - a, alpha);
}

RadialKernel::RadialKernel(double alpha) : alpha_(alpha) {
  if (!(alpha > 0.0))
    throw InputError("RadialKernel: alpha must be > 0, got " + std::to_string(alpha));
  if (std::isinf(alpha)) return;
  table_.resize(kTerms * kPieces);
  for (int piece = 0; piece < kPieces; ++piece) {
    double sample[kTerms];
    for (int i = 0; i < kTerms; ++i)
      sample[i] = psi_by_quadrature(
          (piece + 0.5 + 0.5 * std::cos(pi * (i + 0.5) / kTerms)) * kPiece, alpha);
    for (int n = 0; n < kTerms; ++n) {
      double c = 0.0;
      for (int i = 0; i < kTerms; ++i) c += sample[i] * std::cos(pi * n * (i + 0.5) / kTerms);
      table_[piece * kTerms + n] = c * (n == 0 ? 1.0 : 2.0) / kTerms;
    }
  }
}

double RadialKernel::unit_transform(double u) const {
  if (table_.empty()) return ball_transform(u, 1.0);
  if (u >= kLast) return psi_by_quadrature(u, alpha_);
  const int piece = static_cast<int>(u / kPiece);
  const double* c = table_.data() + piece * kTerms;
  const double z = 2.0 * (u / kPiece - piece) - 1.0;
  double a = 0.0, b = 0.0;  // Clenshaw
  for (int n = kTerms - 1; n > 0; --n) {
    const double next = 2.0 * z * a - b + c[n];
    b = a;
    a = next;
  }
  return z * a - b + c[0];
}

double RadialKernel::transform(double k, double r) const {
  return r * r * r * unit_transform(std::abs(k * r));
}

RadialTransform transform_of(const RadialKernel& kernel) {
  return [kernel](double k, double r) { return kernel.transform(k, r); };
}

}  // namespace mortise
