// SPDX-License-Identifier: GPL-3.0-or-later
// Instrument kernels: their integrals, Remez's ripple, and the promise of the cut-off.
#include "mortise/collision/instrument.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "collision/remez.hpp"
#include "mortise/core/errors.hpp"

namespace mortise {
namespace {

constexpr InstrumentShape kShapes[] = {InstrumentShape::kFejer, InstrumentShape::kHann,
                                       InstrumentShape::kJackson, InstrumentShape::kParksMcClellan};

TEST(Instrument, KernelsAreNonnegativeWithUnitIntegral) {
  for (const InstrumentShape shape : kShapes)
    for (const int degree : {2, 5, 16, 40}) {
      const InstrumentKernel kernel = instrument_kernel(shape, degree, 3.0);
      EXPECT_NEAR(2.0 * kernel.integral(1.5), 1.0, 1e-12);
      double sum = 0.0, moment = 0.0;
      const int steps = 4000;
      for (int i = 0; i < steps; ++i) {
        const double x = 0.7 * (i + 0.5) / steps, v = kernel.value(x);
        EXPECT_GE(kernel.value(1.5 * (i + 0.5) / steps), -1e-9 * kernel.value(0.0));
        sum += v * 0.7 / steps;
        moment += (0.7 - x) * v * 0.7 / steps;
      }
      EXPECT_NEAR(kernel.integral(0.7), sum, 1e-4);
      EXPECT_NEAR(kernel.second_integral(0.7), moment, 1e-4);
    }
}

// Any cosine sum whose error alternates on degree + 2 points with size at least e proves that no
// sum of that degree has a ripple below e (de la Vallee Poussin): `levelled` is such a proof.
TEST(Instrument, RemezReachesTheBestRipple) {
  for (const int degree : {3, 8, 20, 50}) {
    const double pass = 0.4, stop = pass + 8.0 / (degree + 1.0);
    if (stop > 3.0) continue;
    const RemezResult fit = remez(degree, pass, stop);
    double largest = 0.0;
    for (int i = 0; i <= 2000; ++i)
      for (const bool low : {true, false}) {
        const double theta = low ? pass * i / 2000 : stop + (std::numbers::pi - stop) * i / 2000;
        double v = 0.0;
        for (int k = 0; k <= degree; ++k) v += fit.cosines[k] * std::cos(k * theta);
        largest = std::max(largest, std::abs(v - (low ? 1.0 : 0.0)));
      }
    EXPECT_LT(largest, 1.02 * fit.levelled)
        << degree;  // 1% of the exchange, 1% between grid points
    EXPECT_GT(fit.levelled, 0.0);
  }
}

// Worked in one dimension, where everything is closed: S = [-a, a], T = [-b, b], so that the
// obstacle is |t| <= a + b and H, the overlap of the grown segments, a trapezium.
TEST(Instrument, CutoffKeepsItsPromiseInOneDimension) {
  for (const InstrumentShape shape : kShapes)
    for (const int degree : {12, 32, 96}) {
      const double period = 4.0, a = 0.35, b = 0.2;
      const Instrument instrument = best_instrument(shape, degree, period, 1);
      const Cutoff& cutoff = instrument.cutoff;
      if (shape == InstrumentShape::kFejer && degree < 50) continue;  // promises nothing there
      ASSERT_LT(cutoff.hausdorff, 2.0);
      const double ga = a + cutoff.pass_radius, gb = b + cutoff.pass_radius;
      for (double t = 0.0; t <= 2.0; t += 0.01) {
        double v = 0.0;
        const int steps = 4000;
        for (int i = 0; i < steps; ++i) {
          const double y = -2.0 + period * (i + 0.5) / steps;
          const double h = std::max(0.0, std::min({2.0 * ga, 2.0 * gb, ga + gb - std::abs(y)}));
          v += h * instrument.kernel.value(t - y) * period / steps;
        }
        if (t < a + b) {
          EXPECT_GT(v, cutoff.threshold) << t;
        }
        if (t > a + b + cutoff.hausdorff) {
          EXPECT_LE(v, cutoff.threshold * (1.0 + 1e-9)) << t;
        }
      }
    }
}

TEST(Instrument, ErrorsFallWithTheDegree) {
  for (const InstrumentShape shape : kShapes) {
    double last = 1e300;
    for (const int degree : {16, 48, 144}) {
      const double error = best_instrument(shape, degree, 1.0, 3).cutoff.hausdorff;
      EXPECT_LT(error, last);
      last = error;
    }
  }
}

TEST(Instrument, RefusesBadInput) {
  EXPECT_THROW((void)instrument_kernel(InstrumentShape::kFejer, 0, 1.0), InputError);
  EXPECT_THROW((void)instrument_kernel(InstrumentShape::kFejer, 4, 0.0), InputError);
  EXPECT_THROW((void)parks_mcclellan(8, 1.0, 0.3, 0.2), InputError);
  EXPECT_THROW((void)estimate_cutoff(instrument_kernel(InstrumentShape::kHann, 4, 1.0), 4),
               InputError);
}

}  // namespace
}  // namespace mortise
