// SPDX-License-Identifier: GPL-3.0-or-later
// The double-skin channel: pair score by hand, its spectrum, weights and refusals.
#include "mortise/affinity/double_skin.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "mortise/core/errors.hpp"
#include "mortise/kernels/ball.hpp"
#include "reference/score_series.hpp"

namespace mortise {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

Knots one_knot(double radius, std::complex<double> weight, double x = 0.0) {
  Knots knots{Eigen::Matrix4Xd(4, 1), Eigen::VectorXcd(1)};
  knots.points << x, 0.0, 0.0, radius;
  knots.weights << weight;
  return knots;
}

// Re c d K(distance) with K^ = fixed_transform moving_transform, by the inverse Hankel transform
// 4 pi Int k^2 K^(k) sinc(2 k d) dk up to k_max. A ball's transform is -r cos(2 pi k r) / (pi k^2)
// there, so that what is cut off at d = 0 is at most 4 r_f r_m s^2 / (pi k_max), s = 1 + lambda the
// sum of both balls' factors, r the larger radius.
double cut_off(double r1, double r2, double penalty, double k_max) {
  return 4.0 * r1 * r2 * std::pow(1.0 + penalty, 2) / (kPi * k_max);
}

double from_spectrum(const Channel& c, double d, double k_max) {
  const double step = 1.0 / 400.0;
  double sum = 0.0;
  for (double k = 0.5 * step; k < k_max; k += step) {
    const double u = 2.0 * kPi * k * d;
    const double sinc = u < 1e-9 ? 1.0 : std::sin(u) / u;
    sum += k * k * c.fixed_transform(k, c.fixed.points(3, 0)) *
           c.moving_transform(k, c.moving.points(3, 0)) * sinc;
  }
  const std::complex<double> weights = c.fixed.weights[0] * c.moving.weights[0];
  return c.weight * weights.real() * 4.0 * kPi * sum * step;
}

TEST(DoubleSkin, PairScoreByHand) {
  // Two balls of radius 1, offset 1, penalty 2, centres 2 apart: cores touch, V(1, 1) = 0.
  // V(2, 1) at d = 2: gap 1, pi (4 + 12 - 3) / 24 = 13 pi / 24. V(2, 2) at d = 2: gap 2,
  // 4 pi (4 + 16) / 24 = 10 pi / 3. Score 2 * 2 * 13 pi / 24 - 10 pi / 3 = -7 pi / 6.
  EXPECT_NEAR(reference::double_skin_pair(1, 1, 2, 1, 2), -7.0 * kPi / 6.0, 1e-13);
  const Channel c = double_skin_channel(one_knot(1, 1.0), one_knot(1, 1.0), {1.0, 2.0});
  EXPECT_NEAR(from_spectrum(c, 2.0, 60.0), -7.0 * kPi / 6.0, 0.05 * cut_off(2.0, 2.0, 2.0, 60.0));
  // On top of each other: -4 V(1) + 4 V(1) - V(2) = -32 pi / 3.
  EXPECT_NEAR(from_spectrum(c, 0.0, 60.0), -32.0 * kPi / 3.0, cut_off(2.0, 2.0, 2.0, 60.0));
}

TEST(DoubleSkin, SpectrumGivesThePairScoreAtAllDistances) {
  struct Case {
    double r1, r2, offset, penalty, w1, w2;
  };
  for (const Case& p : {Case{1.8, 1.8, 1.4, 7.0, 1.0, 1.0}, Case{1.2, 2.5, 0.7, 3.0, 1.5, -0.4},
                        Case{2.0, 0.5, 3.0, 0.0, 0.8, 0.9}}) {
    const Channel c =
        double_skin_channel(one_knot(p.r1, p.w1, 3.0), one_knot(p.r2, p.w2), {p.offset, p.penalty});
    EXPECT_DOUBLE_EQ(c.range, p.r1 + p.r2 + 2.0 * p.offset);
    EXPECT_EQ(c.name, "shape");
    EXPECT_EQ(c.weight, 1.0);
    const double bound =
        std::abs(p.w1 * p.w2) * cut_off(p.r1 + p.offset, p.r2 + p.offset, p.penalty, 100.0);
    for (const double d : {0.0, 0.5, 1.3, 2.2, 3.0, 3.6, 4.4, 5.0, 6.0, 7.5, 9.0}) {
      const double exact =
          p.w1 * p.w2 * reference::double_skin_pair(p.r1, p.r2, d, p.offset, p.penalty);
      // Away from d = 0 the tail oscillates and is smaller still.
      EXPECT_NEAR(from_spectrum(c, d, 100.0), exact, d == 0.0 ? bound : 0.1 * bound)
          << p.r1 << ' ' << d;
      if (d > c.range) {
        EXPECT_EQ(exact, 0.0);
      }
    }
  }
}

TEST(DoubleSkin, ContactPaysAndOverlapCosts) {
  const auto pair = [](double d) { return reference::double_skin_pair(1.8, 1.8, d, 1.4, 7.0); };
  EXPECT_LT(pair(1.0), 0.0);
  EXPECT_GT(pair(4.2), 0.0);
  EXPECT_LT(pair(5.5), 0.0);  // skin on skin only
  EXPECT_EQ(pair(6.5), 0.0);
}

TEST(DoubleSkin, TransformIsBallsDifference) {
  const RadialTransform t = double_skin_transform({1.4, 7.0});
  const double four_thirds = 4.0 / 3.0 * kPi;
  EXPECT_NEAR(t(0.0, 1.8), four_thirds * (std::pow(3.2, 3) - 7.0 * std::pow(1.8, 3)), 1e-12);
}

TEST(DoubleSkin, PenaltyByRadiusKeepsTheRatioOfCoreAndSkin) {
  // Given at 1.8 as 7: core over skin is 7 (1.8 / 3.2)^3 = 1.2459 for every ball.
  const RadialTransform t = double_skin_transform({1.4, 7.0, 1.8});
  const RadialTransform same = double_skin_transform({1.4, 7.0});
  for (const double k : {0.0, 0.1, 0.31}) EXPECT_NEAR(t(k, 1.8), same(k, 1.8), 1e-12);
  for (const double r : {0.3, 1.4, 1.8, 4.0, 50.0}) {
    const double skin = 4.0 / 3.0 * kPi * std::pow(r + 1.4, 3);
    EXPECT_NEAR(t(0.0, r) / skin, 1.0 - 7.0 * std::pow(1.8 / 3.2, 3), 1e-12) << r;
  }
  // Not the skin, only the core changes.
  const double k = 0.2, r = 3.0, penalty = 7.0 * std::pow(1.8 / 3.2 * 4.4 / 3.0, 3);
  EXPECT_NEAR(t(k, r), ball_transform(k, 4.4) - penalty * ball_transform(k, 3.0), 1e-12);
  for (const double bad : {-1.0, kNan, std::numeric_limits<double>::infinity()})
    EXPECT_THROW((void)double_skin_transform({1.4, 7.0, bad}), InputError);
}

TEST(DoubleSkin, RealWeightsBecomeImaginary) {
  const Channel c = double_skin_channel(one_knot(1.0, 0.7), one_knot(1.0, -2.0));
  EXPECT_EQ(c.fixed.weights[0], std::complex<double>(0.0, 0.7));
  EXPECT_EQ(c.moving.weights[0], std::complex<double>(0.0, -2.0));
}

TEST(DoubleSkin, RefusesBadInput) {
  const Knots good = one_knot(1.0, 1.0), none{Eigen::Matrix4Xd(4, 0), Eigen::VectorXcd(0)};
  EXPECT_THROW((void)double_skin_transform({0.0, 7.0}), InputError);
  EXPECT_THROW((void)double_skin_transform({kNan, 7.0}), InputError);
  EXPECT_THROW((void)double_skin_transform({1.4, -1.0}), InputError);
  EXPECT_THROW((void)double_skin_transform({1.4, kNan}), InputError);
  EXPECT_THROW((void)double_skin_transform({std::numeric_limits<double>::infinity(), 7.0}),
               InputError);
  EXPECT_THROW((void)double_skin_channel(one_knot(1.0, {1.0, 0.5}), good), InputError);
  EXPECT_THROW((void)double_skin_channel(good, one_knot(1.0, {0.0, 1.0})), InputError);
  EXPECT_THROW((void)double_skin_channel(one_knot(1.0, {1.0, kNan}), good), InputError);
  EXPECT_THROW((void)double_skin_channel(none, good), InputError);
  EXPECT_THROW((void)double_skin_channel(good, none), InputError);
  EXPECT_THROW((void)double_skin_channel(one_knot(0.0, 1.0), good), InputError);
}

TEST(CheckChannel, RefusesEachFaultAndNamesChannelAndBody) {
  const Knots good = one_knot(1.0, 1.0);
  const Channel fine = double_skin_channel(good, good);
  EXPECT_NO_THROW(check_channel(fine, "test"));
  const auto refused = [](const Channel& c, const std::string& said) {
    try {
      check_channel(c, "test");
    } catch (const InputError& e) {
      return std::string(e.what()).find("test: channel 'shape'" + said) == 0;
    }
    return false;
  };
  Channel c = fine;
  c.fixed.weights.resize(2);
  EXPECT_TRUE(refused(c, ", fixed"));
  c = fine;
  c.moving.points(3, 0) = -1.0;
  EXPECT_TRUE(refused(c, ", moving"));
  c = fine;
  c.fixed_transform = nullptr;
  EXPECT_TRUE(refused(c, ""));
  c = fine;
  c.moving_transform = nullptr;
  EXPECT_TRUE(refused(c, ""));
  for (const double bad : {kNan, std::numeric_limits<double>::infinity()}) {
    c = fine;
    c.weight = bad;
    EXPECT_TRUE(refused(c, ""));
    c = fine;
    c.range = bad;
    EXPECT_TRUE(refused(c, "")) << bad;
  }
  c = fine;
  c.range = -1.0;
  EXPECT_TRUE(refused(c, ""));
}

}  // namespace
}  // namespace mortise
