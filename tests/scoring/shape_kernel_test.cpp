// SPDX-License-Identifier: GPL-3.0-or-later
// Pair kernels of many radii and offsets against one kernel per pair of radii, and sums over pairs
// of two bodies against the common volumes of their balls.
#include "mortise/scoring/shape_kernel.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "mortise/affinity/double_skin.hpp"
#include "mortise/core/errors.hpp"
#include "reference/score_series.hpp"

namespace mortise {
namespace {

Knots random_knots(std::mt19937& random, int count, const Eigen::Vector3d& centre,
                   const std::vector<double>& radii) {
  std::uniform_real_distribution<double> side(-1.0, 1.0);
  Knots knots{Eigen::Matrix4Xd(4, count), Eigen::VectorXcd(count)};
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d p{side(random), side(random), side(random)};
    knots.points.col(i) << centre + 6.0 * p, radii[i % radii.size()];
    knots.weights[i] = 1.0 + 0.5 * side(random);
  }
  return knots;
}

Knots grown(Knots knots, double offset) {
  knots.points.row(3).array() += offset;
  return knots;
}

const std::vector<double> kRadii = {1.4, 1.55, 1.7, 1.8, 1.9, 2.6, 3.3};

TEST(ShapeKernels, EqualTheKernelOfEachPairOfRadii) {
  std::mt19937 random(1);
  const Knots fixed = random_knots(random, 20, {0, 0, 0}, kRadii);
  const Knots moving = random_knots(random, 15, {0, 0, 8}, {1.5, 1.75, 2.2});
  const Channel channel = double_skin_channel(fixed, moving);
  const std::vector<double> offsets = {-0.3, 0.0, 1.0};
  const LowPass low_pass{.cutoff = 0.25};
  for (const double tolerance : {1e-2, 1e-3, 1e-5}) {
    const ShapeKernels kernels(
        channel, {.low_pass = low_pass, .radius_tolerance = tolerance, .offsets = offsets});
    for (std::size_t o = 0; o < offsets.size(); ++o)
      for (const double r : {1.4, 1.8, 3.3})
        for (const double s : {1.5, 2.2}) {
          // The offset is the moving radius' own; the range's taper is that of the largest.
          Channel shifted = channel;
          shifted.range += 1.0;
          const TabulatedKernel exact = shape_kernel(shifted, r, s + offsets[o], low_pass);
          const Eigen::VectorXd b = kernels.moving_factors(s);
          double worst = 0.0;
          for (double d = 0.0; d < kernels.range(); d += 0.31) {
            double sum = 0.0;
            for (int q = 0; q < kernels.terms(); ++q) sum += b[q] * kernels.kernel(r, q, o)(d * d);
            worst = std::max(worst, std::abs(sum - exact(d * d)));
            EXPECT_NEAR(sum, kernels.pair(r, s, d * d, o), 1e-10 * std::abs(exact(0.0)));
          }
          // Errors of both bodies' transforms, weighed by the other's: about twice the tolerance;
          // the kernel at 0 is what is left of the integral of their products' size.
          EXPECT_LT(worst, 4.0 * tolerance * std::abs(exact(0.0)))
              << "offset " << o << " radii " << r << " " << s;
        }
  }
}

TEST(ShapeKernels, OneRadiusIsTheOneKernel) {
  std::mt19937 random(2);
  const Channel channel = double_skin_channel(random_knots(random, 5, {0, 0, 0}, {1.8}),
                                              random_knots(random, 5, {0, 0, 8}, {1.8}));
  const LowPass low_pass{.cutoff = 0.25};
  const ShapeKernels kernels(channel, {.low_pass = low_pass});
  ASSERT_EQ(kernels.terms(), 1);
  EXPECT_EQ(kernels.moving_factors(1.8)[0], 1.0);
  EXPECT_EQ(kernels.kernel(1.8, 0).values, shape_kernel(channel, 1.8, 1.8, low_pass).values);
}

TEST(ShapeKernels, SumsOverPairsAreTheCommonVolumesOfTheDoubleSkins) {
  std::mt19937 random(3);
  const Knots fixed = random_knots(random, 40, {0, 0, 0}, kRadii);
  const Knots moving = random_knots(random, 30, {0, 0, 0}, {1.5, 1.75, 2.2});
  const Channel channel = double_skin_channel(fixed, moving, {.offset = 1.4, .penalty = 7.0});
  const std::vector<double> offsets = {0.0, 0.7};
  // So far out that nothing of the balls' spectra is missed.
  const ShapeKernels kernels(
      channel,
      {.low_pass = {.cutoff = 6.0, .pass = 3.0}, .radius_tolerance = 1e-4, .offsets = offsets});
  for (std::size_t o = 0; o < offsets.size(); ++o)
    for (const double z : {4.0, 6.0, 8.0}) {
      const RigidMotion pose{Eigen::Quaterniond::Identity(), {0.0, 0.0, z}};
      double sum = 0.0;
      for (Eigen::Index i = 0; i < fixed.size(); ++i)
        for (Eigen::Index j = 0; j < moving.size(); ++j) {
          const Eigen::Vector3d y = pose * moving.points.col(j).head<3>().eval();
          // Weights are i w.
          sum -= fixed.weights[i].real() * moving.weights[j].real() *
                 kernels.pair(fixed.points(3, i), moving.points(3, j),
                              (fixed.points.col(i).head<3>() - y).squaredNorm(), o);
        }
      const double exact =
          reference::double_skin_score(fixed, grown(moving, offsets[o]), pose, 1.4, 7.0);
      EXPECT_NEAR(sum, exact, 2e-3 * std::abs(exact) + 20.0) << "offset " << o << " z " << z;
      EXPECT_GT(std::abs(exact), 500.0);
    }
}

TEST(ShapeKernels, RefuseBadInput) {
  std::mt19937 random(4);
  const Channel channel = double_skin_channel(random_knots(random, 5, {0, 0, 0}, {1.8}),
                                              random_knots(random, 5, {0, 0, 8}, {1.8}));
  EXPECT_THROW(ShapeKernels(channel, {}), InputError);  // no finite cutoff
  EXPECT_THROW(ShapeKernels(channel, {.low_pass = {.cutoff = 0.25}, .offsets = {}}), InputError);
  EXPECT_THROW(ShapeKernels(channel, {.low_pass = {.cutoff = 0.25}, .offsets = {-2.0}}),
               InputError);
  const ShapeKernels kernels(channel, {.low_pass = {.cutoff = 0.25}});
  EXPECT_THROW((void)kernels.kernel(1.8, 1), InputError);
  EXPECT_THROW((void)kernels.kernel(1.9, 0), InputError);
}

}  // namespace
}  // namespace mortise
