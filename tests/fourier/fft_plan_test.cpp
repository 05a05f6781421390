// SPDX-License-Identifier: GPL-3.0-or-later
// FFT plans against the plain discrete sum; layouts, kinds and misuse.
#include "mortise/fourier/fft_plan.hpp"

#include <gtest/gtest.h>

#include <complex>
#include <numbers>
#include <random>

#include "mortise/core/errors.hpp"
#include "mortise/fourier/aligned.hpp"

namespace mortise {
namespace {

using std::numbers::pi;

template <class Real>
class FftPlanTest : public testing::Test {
 public:
  using Complex = std::complex<Real>;
  static constexpr double kTolerance = sizeof(Real) == 4 ? 1e-5 : 1e-13;  // of values of order 10

  static AlignedVector<Complex> random_array(int size) {
    std::mt19937 random(size);
    std::uniform_real_distribution<Real> uniform(-1, 1);
    AlignedVector<Complex> a(size);
    for (auto& v : a) v = {uniform(random), uniform(random)};
    return a;
  }
};
using Reals = testing::Types<float, double>;
TYPED_TEST_SUITE(FftPlanTest, Reals);

TYPED_TEST(FftPlanTest, ForwardEqualsThePlainSumAndBackwardUndoesIt) {
  const int rows = 3, columns = 10;
  const auto in = TestFixture::random_array(rows * columns);
  AlignedVector<std::complex<TypeParam>> out(in.size());
  const FftLayout layout = contiguous_layout({rows, columns});
  FftPlan<TypeParam>::complex_to_complex(layout, true, false).run(in.data(), out.data());
  for (int u = 0; u < rows; ++u)
    for (int v = 0; v < columns; ++v) {
      std::complex<double> sum = 0.0;
      for (int x = 0; x < rows; ++x)
        for (int y = 0; y < columns; ++y)
          sum += std::complex<double>(in[x * columns + y]) *
                 std::polar(1.0, -2.0 * pi * (double(u * x) / rows + double(v * y) / columns));
      EXPECT_LT(std::abs(sum - std::complex<double>(out[u * columns + v])),
                TestFixture::kTolerance);
    }
  FftPlan<TypeParam>::complex_to_complex(layout, false, true).run(out.data(), out.data());
  for (std::size_t i = 0; i < in.size(); ++i)
    EXPECT_LT(std::abs(out[i] / TypeParam(rows * columns) - in[i]), TestFixture::kTolerance);
}

TYPED_TEST(FftPlanTest, RealTransformsWithLoopsAndPaddedRowsInPlace) {
  const int rows = 5, n = 12, row = 16;  // reals
  auto grid = TestFixture::random_array(rows * row / 2);
  auto* const reals = reinterpret_cast<TypeParam*>(grid.data());
  const AlignedVector<TypeParam> before(reals, reals + rows * row);
  const FftLayout layout{{FftDim{n, 1, 1}}, {FftDim{rows, row, row / 2}}};
  FftPlan<TypeParam>::real_to_complex(layout, true).run(reals, grid.data());
  for (int r = 0; r < rows; ++r)
    for (int k = 0; k <= n / 2; ++k) {
      std::complex<double> sum = 0.0;
      for (int x = 0; x < n; ++x)
        sum += double(before[r * row + x]) * std::polar(1.0, -2.0 * pi * k * x / n);
      EXPECT_LT(std::abs(sum - std::complex<double>(grid[r * row / 2 + k])),
                TestFixture::kTolerance);
    }
  const FftLayout back{{FftDim{n, 1, 1}}, {FftDim{rows, row / 2, row}}};
  FftPlan<TypeParam>::complex_to_real(back, true).run(grid.data(), reals);
  for (int r = 0; r < rows; ++r)
    for (int x = 0; x < n; ++x)
      EXPECT_NEAR(reals[r * row + x] / n, before[r * row + x], TestFixture::kTolerance);
}

TYPED_TEST(FftPlanTest, RefusesMisuse) {
  AlignedVector<std::complex<TypeParam>> a(8), b(8);
  EXPECT_THROW((void)FftPlan<TypeParam>::complex_to_complex({}, true, true), InputError);
  EXPECT_THROW((void)FftPlan<TypeParam>::complex_to_complex(contiguous_layout({0}), true, true),
               InputError);
  EXPECT_THROW(FftPlan<TypeParam>().run(a.data(), a.data()), InputError);
  const auto plan = FftPlan<TypeParam>::complex_to_complex(contiguous_layout({4}), true, true);
  EXPECT_TRUE(plan);
  EXPECT_THROW(plan.run(a.data(), b.data()), InputError);
  EXPECT_THROW(plan.run(reinterpret_cast<TypeParam*>(a.data()), a.data()), InputError);
  auto* const crooked = reinterpret_cast<std::complex<TypeParam>*>(
      reinterpret_cast<char*>(a.data()) + sizeof(TypeParam));
  EXPECT_THROW(plan.run(crooked, crooked), InputError);
}

TEST(GoodFftSize, IsTheNextEvenNumberOfSmallFactors) {
  EXPECT_EQ(good_fft_size(0), 2);
  EXPECT_EQ(good_fft_size(7), 8);
  EXPECT_EQ(good_fft_size(13), 14);
  EXPECT_EQ(good_fft_size(65), 70);
  EXPECT_EQ(good_fft_size(97), 98);
}

}  // namespace
}  // namespace mortise
