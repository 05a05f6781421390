// SPDX-License-Identifier: GPL-3.0-or-later
// Ball transform against radial quadrature; overlap volume against counting points.
#include "mortise/kernels/ball.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace mortise {
namespace {

using std::numbers::pi;

// 4 pi Int_0^r s^2 sinc(2 k s) ds by Simpson's rule on a fine mesh.
double transform_by_quadrature(double k, double r) {
  const int n = 20000;
  const double h = r / n;
  double sum = 0.0;
  for (int i = 0; i <= n; ++i) {
    const double s = i * h, u = 2.0 * pi * k * s;
    const double value = 4.0 * pi * s * s * (u == 0.0 ? 1.0 : std::sin(u) / u);
    sum += value * (i == 0 || i == n ? 1.0 : i % 2 == 1 ? 4.0 : 2.0);
  }
  return sum * h / 3.0;
}

TEST(BallTransform, EqualsRadialQuadrature) {
  for (const double r : {0.5, 1.8, 3.2})
    for (const double k : {0.0, 1e-4, 0.01, 0.025, 0.027, 0.1, 0.25, 1.0}) {
      // Relative to the volume: the transform crosses zero.
      EXPECT_NEAR(ball_transform(k, r), transform_by_quadrature(k, r), 1e-12 * r * r * r * 4.2)
          << "k=" << k << " r=" << r;
    }
}

TEST(BallOverlap, EqualsSlicedVolume) {
  for (const double d : {0.0, 0.3, 0.9, 1.5, 2.4, 2.6}) {
    const double a = 1.0, b = 1.5;
    const int n = 200000;  // discs of the common solid of revolution along the line of centres
    double sum = 0.0;
    for (int i = 0; i < n; ++i) {
      const double x = -a + (i + 0.5) * 2.0 * a / n;
      const double first = a * a - x * x, second = b * b - (x - d) * (x - d);
      sum += pi * std::max(0.0, std::min(first, second));
    }
    EXPECT_NEAR(ball_overlap_volume(a, b, d), sum * 2.0 * a / n, 1e-8);
  }
}

}  // namespace
}  // namespace mortise
