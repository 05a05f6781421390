// SPDX-License-Identifier: GPL-3.0-or-later
// Instrument kernels: sums and integrals against quadrature, Remez against Chebyshev's closed form.
#include "mortise/kernels/instrument.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mortise/core/errors.hpp"

namespace mortise {
namespace {

constexpr double kPi = std::numbers::pi;

double cosine_sum(const InstrumentKernel& k, double x) {
  double sum = k.coefficients[0];
  for (Eigen::Index j = 1; j <= k.degree(); ++j)
    sum += 2.0 * k.coefficients[j] * std::cos(2.0 * kPi * static_cast<double>(j) * x / k.period);
  return sum / k.period;
}

template <class F>
double midpoint_rule(const F& f, double from, double to, int n) {
  double sum = 0.0;
  for (int i = 0; i < n; ++i) sum += f(from + (to - from) * (i + 0.5) / n);
  return sum * (to - from) / n;
}

TEST(Instrument, ValuesAndIntegralsMatchSumAndQuadrature) {
  for (const int degree : {1, 2, 7, 24}) {
    const InstrumentKernel k = window_kernel(InstrumentWindow::kHann, degree, 3.5);
    for (const double x : {0.0, 0.11, 0.9, 1.75}) {
      EXPECT_NEAR(k(x), cosine_sum(k, x), 1e-12 * k(0.0));
      EXPECT_NEAR(k.antiderivative(x), midpoint_rule(k, 0.0, x, 20000), 1e-6);
      EXPECT_NEAR(k.absolute_mass(0.0, x),
                  midpoint_rule([&](double y) { return std::abs(k(y)); }, 0.0, x, 20000), 1e-6);
    }
    EXPECT_NEAR(2.0 * k.antiderivative(1.75), 1.0, 1e-12);
  }
}

TEST(Instrument, FejerIsNonNegative) {
  const InstrumentKernel k = window_kernel(InstrumentWindow::kFejer, 9, 1.0);
  for (int i = 0; i <= 1000; ++i) EXPECT_GE(k(i * 5e-4), -1e-12);
  EXPECT_NEAR(k.absolute_mass(-0.5, 0.5), 1.0, 1e-9);
}

// With the pass band a point, the best polynomial is Chebyshev's: on the stop band, mapped to
// [-1, 1], delta T_n, and 1 - delta at x = 0. The exchange looks for extrema on 24 samples per
// mode, which moves the result by up to 1e-4 of the peak.
TEST(ParksMcClellan, EqualsChebyshevWhenThePassBandIsAPoint) {
  for (const int degree : {5, 8, 20, 48, 96}) {
    const double stop = 1.7 / degree;
    const InstrumentKernel k = parks_mcclellan_kernel(degree, 1.0, 0.0, stop);
    const double edge = std::cos(2.0 * kPi * stop);
    const auto u = [&](double x) {
      return (2.0 * std::cos(2.0 * kPi * x) + 1.0 - edge) / (1.0 + edge);
    };
    const auto chebyshev = [&](double y) {
      return y > 1.0 ? std::cosh(degree * std::acosh(y))
                     : std::cos(degree * std::acos(std::max(-1.0, y)));
    };
    const double scale = k(0.0) / chebyshev(u(0.0));
    for (int i = 0; i <= 200; ++i)
      EXPECT_NEAR(k(i * 0.0025), scale * chebyshev(u(i * 0.0025)), 2e-4 * k(0.0))
          << degree << " " << i;
  }
}

TEST(ParksMcClellan, AlternatesAtDegreePlusTwoPoints) {
  for (const int degree : {6, 15, 40}) {
    const double pass = 0.4 / degree;
    const double stop = 1.9 / degree;
    const InstrumentKernel k = parks_mcclellan_kernel(degree, 1.0, pass, stop, 5.0);
    // Before scaling the pass band's mean value is near 1: recover that scale from its extremes.
    double pass_low = k(0.0), pass_high = k(0.0), stop_high = 0.0;
    for (int i = 0; i <= 4000; ++i) {
      const double in_pass = k(pass * i / 4000.0);
      pass_low = std::min(pass_low, in_pass);
      pass_high = std::max(pass_high, in_pass);
      stop_high = std::max(stop_high, std::abs(k(stop + (0.5 - stop) * i / 4000.0)));
    }
    const double scale = 0.5 * (pass_low + pass_high);
    const double ripple = 0.5 * (pass_high - pass_low) / scale;
    EXPECT_NEAR(5.0 * stop_high / scale, ripple, 0.02 * ripple) << degree;
    int alternations = 0;
    double last = 0.0;
    const auto visit = [&](double error) {
      if (std::abs(error) < 0.98 * ripple || error * last > 0.0) return;
      last = error;
      ++alternations;
    };
    for (int i = 0; i <= 4000; ++i) visit(1.0 - k(pass * i / 4000.0) / scale);
    for (int i = 0; i <= 40000; ++i) visit(-5.0 * k(stop + (0.5 - stop) * i / 40000.0) / scale);
    EXPECT_GE(alternations, degree + 2);
  }
}

TEST(Instrument, LiftedAndSquaredKernelsAreNonNegative) {
  const InstrumentKernel signed_kernel = parks_mcclellan_kernel(12, 2.0, 0.0, 0.2);
  EXPECT_GT(signed_kernel.absolute_mass(-1.0, 1.0), 1.001);
  for (const InstrumentKernel& k : {lifted_to_nonnegative(signed_kernel), squared(signed_kernel)}) {
    EXPECT_DOUBLE_EQ(k.coefficients[0], 1.0);
    for (int i = 0; i <= 5000; ++i) EXPECT_GE(k(i * 2e-4), -1e-12);
    EXPECT_NEAR(k.absolute_mass(-1.0, 1.0), 1.0, 1e-9);
  }
  const InstrumentKernel square = squared(signed_kernel);
  const double scale = square(0.0) / (signed_kernel(0.0) * signed_kernel(0.0));
  for (const double x : {0.07, 0.3, 0.8})
    EXPECT_NEAR(square(x), scale * signed_kernel(x) * signed_kernel(x), 1e-12 * square(0.0));
}

TEST(Instrument, RefusesBadArguments) {
  EXPECT_THROW((void)window_kernel(InstrumentWindow::kHann, 0, 1.0), InputError);
  EXPECT_THROW((void)window_kernel(InstrumentWindow::kHann, 3, 0.0), InputError);
  EXPECT_THROW((void)parks_mcclellan_kernel(5, 1.0, 0.3, 0.2), InputError);
  EXPECT_THROW((void)parks_mcclellan_kernel(5, 1.0, 0.0, 0.5), InputError);
  EXPECT_THROW((void)parks_mcclellan_kernel(5, 1.0, 0.0, 0.2, 0.0), InputError);
}

}  // namespace
}  // namespace mortise
