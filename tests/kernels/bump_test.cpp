// SPDX-License-Identifier: GPL-3.0-or-later
// Bump kernels: values worked by hand, transforms against Simpson's rule, the limit of large alpha.
#include "mortise/kernels/bump.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "mortise/core/errors.hpp"
#include "mortise/kernels/ball.hpp"
#include "mortise/kernels/low_pass.hpp"

namespace mortise {
namespace {

using std::numbers::pi;

TEST(Bump, ValuesWorkedByHand) {
  EXPECT_EQ(bump(0.0, 2.0), 1.0);
  EXPECT_EQ(bump(1.0, 2.0), 0.0);
  EXPECT_EQ(bump(-1.5, 2.0), 0.0);
  EXPECT_DOUBLE_EQ(bump(0.5, 2.0), std::exp(-1.0 / 3.0));  // 1 / (1 - 4)
  EXPECT_DOUBLE_EQ(bump(-0.25, 1.0), std::exp(-1.0 / 3.0));
  EXPECT_EQ(bump(0.999, std::numeric_limits<double>::infinity()), 1.0);
  EXPECT_EQ(bump(1.0, std::numeric_limits<double>::infinity()), 0.0);
  EXPECT_NEAR(bump(0.9, 200.0), 1.0, 1e-8);
}

// 4 pi Int_0^r s^2 psi(s / r) sinc(2 k s) ds; psi is flat at both ends, so the rule is accurate.
double transform_by_simpson(double k, double r, double alpha) {
  const int n = 40000;
  const double h = r / n;
  double sum = 0.0;
  for (int i = 0; i <= n; ++i) {
    const double s = i * h, u = 2.0 * pi * k * s;
    sum += 4.0 * pi * s * s * bump(s / r, alpha) * (u == 0.0 ? 1.0 : std::sin(u) / u) *
           (i == 0 || i == n ? 1.0
            : i % 2          ? 4.0
                             : 2.0);
  }
  return sum * h / 3.0;
}

TEST(RadialKernel, TransformEqualsQuadrature) {
  for (const double alpha : {1.0, 2.0, 3.5, 8.0, 60.0}) {
    const RadialKernel kernel(alpha);
    for (const double r : {0.7, 2.0, 30.0})
      // k r past the table, and where the integrand oscillates two hundred times
      for (const double k : {0.0, 0.013, 0.1, 0.25, 0.433, 0.6, 3.4}) {
        EXPECT_NEAR(kernel.transform(k, r), transform_by_simpson(k, r, alpha),
                    2e-12 * kernel.volume(r))
            << "alpha " << alpha << " k " << k << " r " << r;
      }
  }
}

TEST(RadialKernel, InfiniteAlphaIsTheBallAndLargeAlphaApproachesIt) {
  const RadialKernel ball, sharp(2000.0);
  for (const double k : {0.0, 0.1, 0.3}) {
    EXPECT_DOUBLE_EQ(ball.transform(k, 1.8), ball_transform(k, 1.8));
    EXPECT_NEAR(sharp.transform(k, 1.8), ball.transform(k, 1.8), 2e-3 * ball.volume(1.8));
  }
  EXPECT_EQ(ball.transform(0.2, -1.5), -ball.transform(0.2, 1.5));
  EXPECT_THROW(RadialKernel{0.0}, InputError);
  EXPECT_THROW(RadialKernel{std::numeric_limits<double>::quiet_NaN()}, InputError);
}

TEST(LowPass, HannReachesZeroAtTheCutoff) {
  const LowPass hann{.cutoff = 0.25, .pass = 0.0}, taper{.cutoff = 0.3, .pass = 0.1}, open;
  EXPECT_EQ(hann(0.0), 1.0);
  EXPECT_NEAR(hann(0.125), 0.5, 1e-15);
  EXPECT_NEAR(hann(0.2499), 0.0, 1e-6);
  EXPECT_EQ(hann(0.25), 0.0);
  EXPECT_EQ(taper(0.1), 1.0);
  EXPECT_NEAR(taper(0.2), 0.5, 1e-15);
  EXPECT_EQ(taper(5.0), 0.0);
  EXPECT_EQ(open(1e9), 1.0);
}

}  // namespace
}  // namespace mortise
