// SPDX-License-Identifier: GPL-3.0-or-later
// Compressed radii against the transforms themselves: intervals, sets, offsets, tolerances.
#include "mortise/kernels/compressed_radius.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "mortise/core/errors.hpp"
#include "mortise/kernels/ball.hpp"
#include "mortise/kernels/bump.hpp"

namespace mortise {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Neither a power of r times a function of k r, nor of one sign: a double skin.
double skin(double k, double r) { return ball_transform(k, r + 1.4) - 7.0 * ball_transform(k, r); }

// Largest error in the tolerance's own measure, on frequencies and radii that no fit has seen.
double error_of(const CompressedRadius& compressed, const RadialTransform& transform, double k_max,
                const LowPass& low_pass, const std::vector<double>& radii) {
  double worst = 0.0;
  for (std::size_t o = 0; o < compressed.offsets().size(); ++o)
    for (const double r : radii) {
      const Eigen::VectorXd b = compressed.radius_factors(r);
      double error = 0.0, scale = 0.0;
      for (int i = 0; i <= 333; ++i) {
        const double k = k_max * i / 333.0;
        const double exact = transform(k, r + compressed.offsets()[o]);
        scale = std::max(scale, low_pass(k) * std::abs(exact));
        error = std::max(error,
                         low_pass(k) * std::abs(compressed.frequency_factors(k, o).dot(b) - exact));
      }
      worst = std::max(worst, error / scale);
    }
  return worst;
}

std::vector<double> between(double low, double high, int count) {
  std::vector<double> radii;
  for (int i = 0; i < count; ++i) radii.push_back(low + (high - low) * i / (count - 1.0));
  return radii;
}

TEST(CompressedRadius, MeetsItsToleranceOnAnInterval) {
  for (const RadialTransform& transform :
       {transform_of(RadialKernel()), transform_of(RadialKernel(2.0)), RadialTransform(skin)})
    for (const double cutoff : {kInfinity, 0.25})
      for (const std::vector<double>& offsets :
           {std::vector{0.0}, std::vector{-0.5, 0.0, 1.4, 2.8}}) {
        int before = 1;
        for (const double tolerance : {1e-2, 1e-3, 1e-6, 1e-9}) {
          const LowPass low_pass{.cutoff = cutoff};
          const CompressedRadius c =
              compress_radius(transform, 0.43, 1.4, 4.8,
                              {.tolerance = tolerance, .offsets = offsets, .low_pass = low_pass});
          EXPECT_LE(c.measured_error(), tolerance);
          EXPECT_LE(error_of(c, transform, 0.43, low_pass, between(1.4, 4.8, 45)), 1.1 * tolerance)
              << "terms " << c.terms();
          EXPECT_GE(c.terms(), before);
          before = c.terms();
        }
        EXPECT_GT(before, 5);  // no more terms than needed
        EXPECT_LE(before, 16);
      }
}

TEST(CompressedRadius, MeetsItsToleranceOnASetAndTakesManyRadiiAsAnInterval) {
  const std::vector<double> atoms = {1.88, 1.64, 1.42, 1.61, 1.77, 1.42, 1.46, 2.6};
  const std::vector<double> many = between(0.3, 9.0, 700);
  for (const std::vector<double>& radii : {atoms, many})
    for (const std::vector<double>& offsets : {std::vector{0.0}, std::vector{0.0, 0.2, 0.4}})
      for (const double tolerance : {1e-2, 1e-3, 1e-6}) {
        const LowPass low_pass{.cutoff = 0.25};
        const CompressedRadius c = compress_radius(
            skin, 0.3, radii, {.tolerance = tolerance, .offsets = offsets, .low_pass = low_pass});
        EXPECT_LE(c.measured_error(), tolerance);
        EXPECT_LE(error_of(c, skin, 0.3, low_pass, radii), 1.1 * tolerance) << c.terms();
      }
  // As many terms as radii are exact, at any tolerance.
  const CompressedRadius two = compress_radius(skin, 0.3, {1.8, 2.4}, {.tolerance = 1e-12});
  EXPECT_LE(two.terms(), 2);
  EXPECT_LE(error_of(two, skin, 0.3, {}, {1.8, 2.4}), 1e-12);
}

TEST(CompressedRadius, OneRadiusIsOneTermWithoutRounding) {
  for (const CompressedRadius& c :
       {compress_radius(skin, 0.3, {1.8, 1.8}, {.offsets = {0.0, 0.7}}),
        compress_radius(skin, 0.3, 1.8, 1.8, {.offsets = {0.0, 0.7}})}) {
    ASSERT_EQ(c.terms(), 1);
    EXPECT_EQ(c.radius_factors(1.8)[0], 1.0);
    EXPECT_EQ(c.frequency_factors(0.123, 0)[0], skin(0.123, 1.8));
    EXPECT_EQ(c.frequency_factors(0.123, 1)[0], skin(0.123, 1.8 + 0.7));
    EXPECT_EQ(c.measured_error(), 0.0);
  }
}

TEST(CompressedRadius, TypicalAtomsAreThreeTerms) {
  EXPECT_LE(
      compress_radius(transform_of(RadialKernel()), 0.25, 1.4, 2.0, {.tolerance = 1e-3}).terms(),
      3);
}

TEST(CompressedRadius, RefusesBadInput) {
  const RadialTransform ball = ball_transform;
  EXPECT_THROW((void)compress_radius(ball, 0.43, 2.0, 1.8), InputError);
  EXPECT_THROW((void)compress_radius(ball, 0.0, 1.0, 1.8), InputError);
  EXPECT_THROW((void)compress_radius(ball, 0.43, 1.0, 1.8, {.tolerance = 0.0}), InputError);
  EXPECT_THROW((void)compress_radius(ball, 0.43, std::vector<double>{}), InputError);
  EXPECT_THROW((void)compress_radius(ball, 0.43, {1.0, 2.0}, {.offsets = {}}), InputError);
  EXPECT_THROW((void)compress_radius(ball, 0.43, {1.0, 2.0}, {.offsets = {-1.0}}), InputError);
  const CompressedRadius set = compress_radius(ball, 0.43, {1.0, 2.0});
  EXPECT_THROW((void)set.radius_factors(1.5), InputError);
  const CompressedRadius interval = compress_radius(ball, 0.43, 1.0, 2.0);
  EXPECT_NO_THROW((void)interval.radius_factors(1.5));
  EXPECT_THROW((void)interval.radius_factors(2.1), InputError);
  EXPECT_THROW((void)interval.frequency_factors(0.1, 1), std::out_of_range);
}

}  // namespace
}  // namespace mortise
