// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Transforms of the axes of a grid, many columns or rows side by side.
#pragma once

#include <array>
#include <complex>
#include <cstddef>
#include <vector>

#include "fourier/lane_fft_isa.hpp"
#include "mortise/fourier/aligned.hpp"

namespace mortise {

/// Unnormalised transforms of n points along a strided axis, many columns at once, in single
/// precision. The plan is a table, not a measurement: the same bytes in every process.
class LaneFft {
 public:
  static constexpr int kColumns = 8;  ///< columns come in multiples of this

  LaneFft() = default;  ///< empty: nothing must be called
  /// @throws InputError unless n >= 2 has no prime factor above 7
  explicit LaneFft(int n);

  /// What one thread needs beside.
  using Work = AlignedVector<float>;
  [[nodiscard]] Work make_work() const { return Work(4 * 16 * static_cast<std::size_t>(n_)); }

  /// @param in_count   elements from there on are taken as 0 and not read; <= n
  /// @param columns    a multiple of kColumns, one beside the other
  /// @param in_stride, out_stride  complex numbers from one element of a column to the next; in may
  /// be out where both are laid out alike, else they must not overlap
  void run(bool forward, const std::complex<float>* in, std::ptrdiff_t in_stride,
           std::ptrdiff_t in_count, std::complex<float>* out, std::ptrdiff_t out_stride,
           std::ptrdiff_t columns, Work& work) const;

  /// The contiguous axis: real rows of n floats to n / 2 + 1 complex numbers each. Of `out` as many
  /// more are overwritten as make a multiple of kColumns.
  void forward_rows(const float* in, std::ptrdiff_t in_stride, std::ptrdiff_t rows,
                    std::complex<float>* out, std::ptrdiff_t out_stride, Work& work) const;
  /// The way back, unnormalised; reads what the other writes. Imaginary parts at frequencies 0 and
  /// n / 2 do not count.
  void backward_rows(const std::complex<float>* in, std::ptrdiff_t in_stride, std::ptrdiff_t rows,
                     float* out, std::ptrdiff_t out_stride, Work& work) const;

 private:
  [[nodiscard]] LaneFftPasses passes(bool forward) const;

  int n_ = 0;
  std::vector<int> radices_ = {};
  std::array<std::vector<std::vector<float>>, 2> twiddles_ = {};  // backward, forward: of each pass
  const LaneFftTable* table_ = nullptr;
};

}  // namespace mortise
