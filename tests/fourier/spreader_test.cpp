// SPDX-License-Identifier: GPL-3.0-or-later
// Spreading against the kernel itself, cell by cell, and what a plan in use allocates.
#include "mortise/fourier/spreader.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "mortise/core/errors.hpp"
#include "mortise/fourier/nfft.hpp"

long count_of_allocations();  // counting_new.cpp

namespace mortise {
namespace {

template <class Real>
void compare_with_kernel(int width_wanted) {
  const std::array size{20, 18, 24};
  const std::array modes{10, 9, 12};
  const SpreadKernel kernel =
      design_spread_kernel(std::pow(10.0, -width_wanted), modes, size, 1e-16);
  const std::array box{5.0, 6.0, 7.0};
  Spreader<3, Real> spreader(size, box, kernel, WeightKind::kComplex, 1);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Eigen::Matrix3Xd points(3, 7);
  Eigen::VectorX<std::complex<Real>> weights(7);
  for (int i = 0; i < 7; ++i) {
    points.col(i) << 5.0 * uniform(random), 6.0 * uniform(random), 7.0 * uniform(random);
    weights[i] = {static_cast<Real>(uniform(random)), static_cast<Real>(uniform(random))};
  }
  AlignedVector<Real> grid(spreader.grid_size());
  spreader.spread(points, weights, grid.data());
  const auto periodic = [&](double x, int d, int cell) {
    const double distance = cell - x / box[d] * size[d];
    return kernel(distance - size[d] * std::round(distance / size[d]));
  };
  const double tolerance = 8.0 * kernel.fit_error * 3.0 + (sizeof(Real) == 4 ? 2e-6 : 1e-14);
  for (int x = 0; x < size[0]; ++x)
    for (int y = 0; y < size[1]; ++y)
      for (int z = 0; z < size[2]; ++z) {
        std::complex<double> expected = 0.0;
        for (int i = 0; i < 7; ++i)
          expected += std::complex<double>(weights[i]) * periodic(points(0, i), 0, x) *
                      periodic(points(1, i), 1, y) * periodic(points(2, i), 2, z);
        const Real* cell = grid.data() + x * spreader.stride(0) + y * spreader.stride(1) + 2 * z;
        ASSERT_LT(std::abs(expected - std::complex<double>(cell[0], cell[1])), tolerance)
            << x << " " << y << " " << z << " width " << kernel.width;
      }
}

TEST(Spreader, PutsTheKernelOnEveryCell) {
  for (const int digits : {1, 2, 3, 5, 8, 11}) compare_with_kernel<double>(digits);
  for (const int digits : {1, 2, 4, 6}) compare_with_kernel<float>(digits);
}

TEST(SpreadKernel, TransformIsTheIntegral) {
  const SpreadKernel kernel = design_spread_kernel(1e-5, std::array{32}, std::array{64}, 1e-16);
  for (const double nu : {0.0, 0.1, 0.25, 0.8, 1.3}) {
    double sum = 0.0;
    const int n = 20000;
    for (int i = 0; i < n; ++i) {
      const double x = kernel.width * ((i + 0.5) / n - 0.5);
      sum += kernel(x) * std::cos(2.0 * std::numbers::pi * nu * x) * kernel.width / n;
    }
    EXPECT_NEAR(kernel.transform(nu), sum, 1e-8);
  }
  EXPECT_THROW((void)design_spread_kernel(0.0, std::array{32}, std::array{64}, 1e-16), InputError);
  EXPECT_THROW((void)design_spread_kernel(1e-3, std::array{65}, std::array{64}, 1e-16), InputError);
}

TEST(Nfft, AllocatesNothingOnceWarm) {
  for (const int n : {24, 80}) {  // spread in order, and in tiles
    Nfft3 plan({n, n, n}, {1.0, 1.0, 1.0}, {.tolerance = 1e-3, .upsampling = 2.0, .threads = 1});
    const Eigen::Matrix3Xd points = Eigen::Matrix3Xd::Random(3, 500);
    const Eigen::VectorXcd weights = Eigen::VectorXcd::Random(500);
    (void)plan.transform(points, weights);
    const long before = count_of_allocations();
    (void)plan.transform(points, weights);
    EXPECT_EQ(count_of_allocations() - before, 0) << n;
  }
}

}  // namespace
}  // namespace mortise
