// SPDX-License-Identifier: GPL-3.0-or-later
// Bump kernels and their transforms.
#include "mortise/kernels/bump.hpp"

#include <algorithm>
#include <boost/math/quadrature/tanh_sinh.hpp>
#include <boost/math/special_functions/chebyshev.hpp>
#include <cmath>
#include <numbers>
#include <string>

#include "core/chebyshev.hpp"
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
// mind what psi does at either end. In pieces of few oscillations: with many the rule's coarse
// steps agree on something else.
double psi_by_quadrature(double u, double alpha) {
  static boost::math::quadrature::tanh_sinh<double> rule;  // safe to share; not const in Boost 1.74
  const int pieces = 1 + static_cast<int>(u / kLast);
  double sum = 0.0;
  for (int piece = 0; piece < pieces; ++piece) {
    const double begin = static_cast<double>(piece) / pieces,
                 end = static_cast<double>(piece + 1) / pieces;
    // `to_end` is the distance to the nearer end, at the upper one positive.
    const auto integrand = [&](double s, double to_end) {
      const double v = 2.0 * pi * u * s;
      const double one_minus_s = end == 1.0 && to_end > 0.0 && s > 0.5 ? to_end : 1.0 - s;
      return s * s * bump_below_one(one_minus_s, alpha) * (v < 1e-9 ? 1.0 : std::sin(v) / v);
    };
    sum += rule.integrate(integrand, begin, end, 1e-13);
  }
  return 4.0 * pi * sum;
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
    std::vector<double> sample(kTerms);
    for (int i = 0; i < kTerms; ++i)
      sample[i] =
          psi_by_quadrature((piece + 0.5 + 0.5 * chebyshev_zero(i, kTerms)) * kPiece, alpha);
    const std::vector<double> series = chebyshev_series(sample, kTerms);
    std::copy(series.begin(), series.end(), table_.begin() + piece * kTerms);
  }
}

double RadialKernel::unit_transform(double u) const {
  if (table_.empty()) return ball_transform(u, 1.0);
  if (u >= kLast) return psi_by_quadrature(u, alpha_);
  const int piece = static_cast<int>(u / kPiece);
  return boost::math::chebyshev_clenshaw_recurrence(table_.data() + piece * kTerms, kTerms,
                                                    2.0 * (u / kPiece - piece) - 1.0);
}

double RadialKernel::transform(double k, double r) const {
  return r * r * r * unit_transform(std::abs(k * r));
}

RadialTransform transform_of(const RadialKernel& kernel) {
  return [kernel](double k, double r) { return kernel.transform(k, r); };
}

}  // namespace mortise
