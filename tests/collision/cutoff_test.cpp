// SPDX-License-Identifier: GPL-3.0-or-later
// Certified cut-offs: balls and boxes, whose obstacles and spectra are known exactly.
#include "mortise/collision/cutoff.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "mortise/core/errors.hpp"
#include "mortise/kernels/ball.hpp"

namespace mortise {
namespace {

// V(t) of two balls of radii a and b at distance t along x, each fattened by x0: the direct triple
// sum.
double ball_gap(const InstrumentKernel& k, const Cutoff& c, double a, double b, double t) {
  const auto n = static_cast<int>(k.degree());
  double sum = 0.0;
  for (int i = -n; i <= n; ++i)
    for (int j = -n; j <= n; ++j)
      for (int l = -n; l <= n; ++l) {
        const double w = std::sqrt(static_cast<double>(i * i + j * j + l * l)) / k.period;
        sum += k.coefficients[std::abs(i)] * k.coefficients[std::abs(j)] *
               k.coefficients[std::abs(l)] * ball_transform(w, a + c.fattening) *
               ball_transform(w, b + c.fattening) *
               std::cos(2.0 * std::numbers::pi * i * t / k.period);
      }
  return sum / std::pow(k.period, 3);
}

TEST(Cutoff, NeverMissesBallsThatMeetAndClearsThoseBeyondTheError) {
  const double period = 1.0;
  for (const int degree : {8, 16, 24}) {
    const double a = 0.06;
    const double b = 0.09;
    CutoffOptions options;
    options.largest_overlap = 4.0 / 3.0 * std::numbers::pi * std::pow(a + 0.1, 3);
    const Instrument best = best_instrument(degree, period, options);
    ASSERT_LE(best.cutoff.fattening, 0.1) << "the overlap given must cover the fattened ball";
    for (const double inside : {0.0, 0.5, 0.9, 0.999})
      EXPECT_GE(ball_gap(best.kernel, best.cutoff, a, b, inside * (a + b)), best.cutoff.threshold);
    const double clear = a + b + best.cutoff.hausdorff_error;
    for (const double outside : {1.001, 1.1, 1.3})
      if (outside * clear < 0.5 * period) {
        EXPECT_LT(ball_gap(best.kernel, best.cutoff, a, b, outside * clear), best.cutoff.threshold)
            << degree;
      }
  }
}

// Two points that coincide are the hardest case inside: nothing but the fattening overlaps.
TEST(Cutoff, ThresholdIsTightForTwoPoints) {
  const InstrumentKernel k = lifted_to_nonnegative(parks_mcclellan_kernel(12, 1.0, 0.0, 0.15));
  const Cutoff c = estimate_cutoff(k, {.largest_overlap = 0.01});
  EXPECT_NEAR(ball_gap(k, c, 0.0, 0.0, 0.0), c.threshold, 1e-6 * c.threshold);
}

TEST(Cutoff, CubesHoldOnEveryAxis) {
  const InstrumentKernel k = lifted_to_nonnegative(parks_mcclellan_kernel(16, 1.0, 0.0, 0.12));
  const double half_a = 0.05;
  const double half_b = 0.08;
  CutoffOptions options{.dimension = 2, .fattening = Fattening::kCube};
  options.largest_overlap = std::pow(2.0 * (half_a + 0.1), 2);
  const Cutoff c = estimate_cutoff(k, options);
  ASSERT_LE(c.fattening, 0.1);
  const auto axis = [&](double t) {  // convolution of two intervals and the kernel
    double sum = 4.0 * (half_a + c.fattening) * (half_b + c.fattening);
    for (Eigen::Index j = 1; j <= k.degree(); ++j) {
      const double w = std::numbers::pi * static_cast<double>(j);
      sum += 2.0 * k.coefficients[j] * std::sin(2.0 * w * (half_a + c.fattening)) / w *
             std::sin(2.0 * w * (half_b + c.fattening)) / w * std::cos(2.0 * w * t);
    }
    return sum;
  };
  const double touch = half_a + half_b;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-0.5, 0.5);
  int inside = 0, outside = 0;
  for (int i = 0; i < 4000; ++i) {
    const double x = uniform(random);
    const double y = uniform(random);
    const double reach = std::max(std::abs(x), std::abs(y));
    if (reach <= touch) {
      ++inside;
      EXPECT_GE(axis(x) * axis(y), c.threshold);
    } else if (reach > touch + c.hausdorff_error) {
      ++outside;
      EXPECT_LT(axis(x) * axis(y), c.threshold);
    }
  }
  EXPECT_GT(inside, 100);
  EXPECT_GT(outside, 100);
}

TEST(Cutoff, SignedKernelsPayForTheirNegativePart) {
  const InstrumentKernel k = parks_mcclellan_kernel(16, 1.0, 0.0, 0.15);
  CutoffOptions options{.largest_overlap = 0.01};
  const Cutoff c = estimate_cutoff(k, options);
  EXPECT_LT(c.threshold, 4.0 / 3.0 * std::numbers::pi * std::pow(c.fattening, 3));
  // Dirichlet's kernel, no window at all: too negative for any threshold.
  EXPECT_THROW((void)estimate_cutoff({1.0, Eigen::VectorXd::Ones(7)}), InputError);
}

TEST(Cutoff, ErrorFallsNearlyAsOneOverTheModes) {
  const CutoffOptions options{.largest_overlap = 0.02};
  double last = 1e9;
  for (const int degree : {8, 16, 32, 64}) {
    const double error = best_instrument(degree, 1.0, options).cutoff.hausdorff_error;
    EXPECT_LT(error, 0.7 * last) << degree;
    last = error;
  }
}

TEST(Cutoff, RefusesBadOptions) {
  const InstrumentKernel k = window_kernel(InstrumentWindow::kFejer, 8, 1.0);
  EXPECT_THROW((void)estimate_cutoff(k, {.dimension = 4}), InputError);
  EXPECT_THROW((void)estimate_cutoff(k, {.largest_overlap = -1.0}), InputError);
  EXPECT_THROW((void)estimate_cutoff(k, {.steps = 3}), InputError);
  EXPECT_THROW((void)best_instrument(1, 1.0), InputError);
}

}  // namespace
}  // namespace mortise
