// SPDX-License-Identifier: GPL-3.0-or-later
// Transforms of columns side by side against direct sums, for every size that a grid may have.
#include "fourier/lane_fft.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "mortise/core/errors.hpp"
#include "mortise/fourier/fft_plan.hpp"

namespace mortise {
namespace {

using Cfloat = std::complex<float>;

// Relative rms error against sums in double precision, of the columns of one transform.
double error_of(int n, bool forward, int in_count, int columns, bool in_place) {
  std::mt19937 random(static_cast<unsigned>(n));
  std::uniform_real_distribution<float> number(-1.0F, 1.0F);
  const int in_stride = columns + 8, out_stride = in_place ? in_stride : columns + 16;
  AlignedVector<Cfloat> in(static_cast<std::size_t>(n) * in_stride);
  for (Cfloat& c : in) c = {number(random), number(random)};
  const AlignedVector<Cfloat> before = in;
  AlignedVector<Cfloat> apart(static_cast<std::size_t>(n) * out_stride, Cfloat(7.0F, 7.0F));
  AlignedVector<Cfloat>& out = in_place ? in : apart;
  const LaneFft fft(n);
  LaneFft::Work work = fft.make_work();
  fft.run(forward, in.data(), in_stride, in_count, out.data(), out_stride, columns, work);
  double error = 0.0, size = 0.0;
  for (int k = 0; k < n; ++k) {
    for (int c = 0; c < columns; ++c) {
      std::complex<double> sum = 0.0;
      for (int j = 0; j < in_count; ++j)
        sum += std::complex<double>(before[j * in_stride + c]) *
               std::polar(1.0, (forward ? -2.0 : 2.0) * std::numbers::pi *
                                   static_cast<double>(static_cast<long>(j) * k % n) / n);
      error += std::norm(sum - std::complex<double>(out[k * out_stride + c]));
      size += std::norm(sum);
    }
    for (int c = columns; c < out_stride; ++c) {  // what lies between the columns is left alone
      EXPECT_EQ(out[k * out_stride + c], in_place ? before[k * in_stride + c] : Cfloat(7.0F, 7.0F));
    }
  }
  return std::sqrt(error / size);
}

// Rounding grows with the root of the number of passes: 2e-7 is found.
TEST(LaneFft, IsTheDirectSumForEverySizeOfAGrid) {
  for (int n = 2; n <= 162; n = good_fft_size(n + 1))
    for (const bool forward : {true, false}) {
      EXPECT_LT(error_of(n, forward, n, 8, false), 5e-7) << n;
      EXPECT_LT(error_of(n, forward, (n + 1) / 2, 24, n % 4 == 0), 5e-7) << n;
    }
  for (const int n : {3, 5, 7, 15, 21, 200, 343, 1000})
    EXPECT_LT(error_of(n, true, n, 8, false), 5e-7) << n;
}

// Rows there and back, against FFTW's; what is no part of a row stays as it is.
TEST(LaneFft, RowsAreThoseOfTheReferenceBothWays) {
  for (int n = 2; n <= 120; n = n < 10 ? n + 1 : good_fft_size(n + 1))
    for (const int rows : {1, 16, 37}) {
      std::mt19937 random(static_cast<unsigned>(n));
      std::uniform_real_distribution<float> number(-1.0F, 1.0F);
      const int nc = n / 2 + 1, stride = n + 3, columns = (nc + 7) / 8 * 8;
      AlignedVector<float> in(static_cast<std::size_t>(rows) * stride);
      for (float& x : in) x = number(random);
      AlignedVector<Cfloat> out(static_cast<std::size_t>(rows) * columns),
          expected(static_cast<std::size_t>(rows) * columns);
      const LaneFft fft(n);
      LaneFft::Work work = fft.make_work();
      fft.forward_rows(in.data(), stride, rows, out.data(), columns, work);
      FftPlan<float>::real_to_complex({{{n, 1, 1}}, {{rows, stride, columns}}}, false)
          .run(in.data(), expected.data());
      const auto error = [](const auto& a, const auto& b, int part, int whole) {
        double sum = 0.0, size = 0.0;
        for (std::size_t i = 0; i < a.size(); ++i) {
          if (static_cast<int>(i) % whole >= part) continue;
          sum += std::norm(a[i] - b[i]);
          size += std::norm(b[i]);
        }
        return std::sqrt(sum / size);
      };
      EXPECT_LT(error(out, expected, nc, columns), 5e-7) << n << " " << rows;

      for (Cfloat& c : out) c = {number(random), number(random)};
      AlignedVector<float> back(in.size(), 7.0F), back_expected(in.size(), 7.0F);
      fft.backward_rows(out.data(), columns, rows, back.data(), stride, work);
      FftPlan<float>::complex_to_real({{{n, 1, 1}}, {{rows, columns, stride}}}, false)
          .run(out.data(), back_expected.data());
      EXPECT_LT(error(back, back_expected, n, stride), 5e-7) << n << " " << rows;
      for (std::size_t i = 0; i < back.size(); ++i) {
        if (static_cast<int>(i) % stride >= n) {
          EXPECT_EQ(back[i], 7.0F);
        }
      }
    }
}

TEST(LaneFft, NothingInNothingOut) {
  const LaneFft fft(36);
  LaneFft::Work work = fft.make_work();
  AlignedVector<Cfloat> data(36 * 8, Cfloat(1.0F, 1.0F));
  fft.run(true, data.data(), 8, 0, data.data(), 8, 8, work);
  for (const Cfloat& c : data) EXPECT_EQ(c, Cfloat());
}

TEST(LaneFft, RefusesOtherSizes) {
  for (const int n : {0, 1, -4, 11, 26}) EXPECT_THROW(LaneFft{n}, InputError) << n;
}

}  // namespace
}  // namespace mortise
