// SPDX-License-Identifier: GPL-3.0-or-later
// Design of the Kaiser-Bessel spreading kernel and its piecewise polynomials; derivation in
// docs/math.md.
#include "mortise/fourier/spread_kernel.hpp"

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <span>
#include <string>

#include "core/chebyshev.hpp"
#include "fourier/spread_isa.hpp"
#include "mortise/core/errors.hpp"

namespace mortise {
namespace {

using std::numbers::pi;

constexpr int kBetaBits = 12;  // the error is flat about its minimum

// The transform but for the factor width / I0(beta).
double transform_shape(int width, double beta, double nu) {
  const double v = pi * width * nu, square = beta * beta - v * v, s = std::sqrt(std::abs(square));
  return s < 1e-4 ? 1.0 + square / 6.0 : square > 0.0 ? std::sinh(s) / s : std::sin(s) / s;
}

// What one axis contributes, as means over its modes: `aliasing` of sum_m |phi^(nu + m) /
// phi^(nu)|^2, and `gain` of |phi^(0) / phi^(nu)|^2, by which the correction magnifies rounding
// errors.
struct AxisError {
  double aliasing = 0.0, gain = 0.0;
};

AxisError axis_error(const SpreadKernel& kernel, int modes, int size) {
  constexpr int kImages = 4, kSamples = 64;
  // Images beyond kImages, all in step at the worst place of a point: they make up the jump at the
  // kernel's edge.
  const double jump = 0.1 / kernel.width;
  const auto transform = [&](double nu) { return transform_shape(kernel.width, kernel.beta, nu); };
  const double centre = transform(0.0);
  const int samples = std::min(modes, kSamples);
  AxisError error;
  for (int i = 0; i < samples; ++i) {
    const double k = samples == modes ? i - modes / 2 : ((i + 0.5) / samples - 0.5) * modes;
    const double nu = k / size, own = transform(nu);
    double images = jump * jump;
    for (int m = 1; m <= kImages; ++m) {
      const double up = transform(nu + m), down = transform(nu - m);
      images += up * up + down * down;
    }
    error.aliasing += images / (own * own) / samples;
    error.gain += centre * centre / (own * own) / samples;
  }
  return error;
}

struct TotalError {
  double aliasing = 0.0, rounding = 0.0;
};

TotalError total_error(const SpreadKernel& kernel, std::span<const int> modes,
                       std::span<const int> size, double epsilon) {
  TotalError total;
  double gain = 1.0;
  for (std::size_t d = 0; d < modes.size(); ++d) {
    const AxisError axis = axis_error(kernel, modes[d], size[d]);
    total.aliasing += axis.aliasing;
    gain *= axis.gain;
  }
  total.aliasing = std::sqrt(total.aliasing);
  total.rounding =
      0.3 * epsilon * std::sqrt(gain);  // 0.3: measured, spreading and transform together
  return total;
}

}  // namespace

double SpreadKernel::operator()(double x) const {
  const double u = 1.0 - 4.0 * x * x / (static_cast<double>(width) * width);
  if (u < -1e-12) return 0.0;
  return std::cyl_bessel_i(0.0, beta * std::sqrt(std::max(0.0, u))) / std::cyl_bessel_i(0.0, beta);
}

double SpreadKernel::transform(double nu) const {
  return width * transform_shape(width, beta, nu) / std::cyl_bessel_i(0.0, beta);
}

SpreadKernel design_spread_kernel(double tolerance, std::span<const int> modes,
                                  std::span<const int> size, double epsilon) {
  if (!(tolerance > 0.0 && tolerance < 1.0))
    throw InputError("design_spread_kernel: tolerance must be in (0, 1), got " +
                     std::to_string(tolerance));
  if (modes.empty() || modes.size() != size.size())
    throw InputError("design_spread_kernel: expected as many mode counts as grid sizes");
  double last = 0.0;  // the highest frequency of any axis
  for (std::size_t d = 0; d < modes.size(); ++d) {
    if (modes[d] < 1 || size[d] < modes[d])
      throw InputError("design_spread_kernel: expected 1 <= modes <= grid size, got " +
                       std::to_string(modes[d]) + " and " + std::to_string(size[d]));
    last = std::max(last, (modes[d] / 2) / static_cast<double>(size[d]));
  }
  SpreadKernel kernel;
  for (kernel.width = kMinSpreadWidth; kernel.width <= kMaxSpreadWidth; ++kernel.width) {
    // The best beta; near the upper end the first image starts inside the kernel's main lobe.
    const double most = pi * kernel.width * (1.0 - std::min(0.45, last));
    kernel.beta = boost::math::tools::brent_find_minima(
                      [&](double beta) {
                        kernel.beta = beta;
                        return total_error(kernel, modes, size, epsilon).aliasing;
                      },
                      0.3 * most, 1.05 * most, kBetaBits)
                      .first;
    const TotalError error = total_error(kernel, modes, size, epsilon);
    // A single point can be placed so that its two nearest images add up: sqrt(2) times the mean
    // over places.
    kernel.expected_error = std::numbers::sqrt2 * error.aliasing + error.rounding;
    if (kernel.expected_error <= tolerance) {
      // Errors e of all cells may add up at a mode: width e / phi^(nu), worst at the last mode,
      // where phi^ is least.
      kernel.fit_error = 0.1 * tolerance * kernel.transform(last) /
                         (std::sqrt(static_cast<double>(modes.size())) * kernel.width);
      return kernel;
    }
  }
  char wanted[32];
  std::snprintf(wanted, sizeof wanted, "%.1e", tolerance);
  throw InputError(std::string("design_spread_kernel: tolerance ") + wanted +
                   " cannot be had with " + std::to_string(kMaxSpreadWidth) +
                   " cells on this grid in this precision; raise the upsampling");
}

KernelPieces fit_pieces(const SpreadKernel& kernel, int stride) {
  if (stride < kernel.width)
    throw InputError("fit_pieces: stride must be >= the width, got " + std::to_string(stride));
  constexpr int kMaxDegree = 20;
  // Rows of a lower triangular table: T_n(z) as a polynomial in z.
  std::vector<std::vector<double>> chebyshev(kMaxDegree + 1,
                                             std::vector<double>(kMaxDegree + 1, 0.0));
  chebyshev[0][0] = chebyshev[1][1] = 1.0;
  for (int n = 2; n <= kMaxDegree; ++n)
    for (int p = 0; p <= n; ++p)
      chebyshev[n][p] = (p > 0 ? 2.0 * chebyshev[n - 1][p - 1] : 0.0) - chebyshev[n - 2][p];

  const auto value = [&](int piece, double z) {
    return kernel(piece - 0.5 * kernel.width + 0.5 * (z + 1.0));
  };
  KernelPieces best;
  double best_error = std::numeric_limits<double>::infinity();
  for (int degree = 2; degree <= kMaxDegree; ++degree) {
    KernelPieces pieces{degree, stride,
                        std::vector<double>(static_cast<std::size_t>(degree + 1) * stride, 0.0)};
    double error = 0.0;
    for (int j = 0; j < kernel.width; ++j) {
      std::vector<double> power(degree + 1, 0.0), sample(degree + 1);
      for (int i = 0; i <= degree; ++i) sample[i] = value(j, chebyshev_zero(i, degree + 1));
      std::vector<double> series = chebyshev_series(sample, degree + 1);
      series[0] *= 0.5;
      for (int n = 0; n <= degree; ++n)
        for (int p = 0; p <= n; ++p) power[p] += series[n] * chebyshev[n][p];
      for (int p = 0; p <= degree; ++p) pieces.coefficients[(degree - p) * stride + j] = power[p];
      for (int i = 0; i <= 4 * degree; ++i) {
        const double z = -1.0 + 0.5 * i / degree;
        double v = 0.0;
        for (int p = degree; p >= 0; --p) v = v * z + power[p];
        error = std::max(error, std::abs(v - value(j, z)));
      }
    }
    if (error < best_error) best = pieces, best_error = error;
    if (best_error <= kernel.fit_error) break;
  }
  return best;
}

}  // namespace mortise
