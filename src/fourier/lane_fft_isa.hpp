// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Transforms of many columns side by side, compiled once per instruction set. Types only.
#pragma once

#include <cstddef>

namespace mortise {

/// One axis of n = product of radices points, as passes of Stockham's scheme.
struct LaneFftPasses {
  static constexpr int kMost = 12;
  int n = 1;
  int count = 0;          ///< of passes
  int radix[kMost] = {};  ///< each of 2 to 10, 12, 14, 15 and 16
  /// Of each pass but the last: for each p below the points left over and each u = 1 .. radix - 1
  /// the factor exp(-+ 2 pi i p u / left) as (re, re, -im, im).
  const float* twiddles[kMost] = {};
};

struct LaneFftTable {
  /// Transforms `columns` columns of complex numbers, (re, im) pairs side by side; the elements of
  /// a column are `in_stride` and `out_stride` floats apart. Unnormalised; `forward` is exp(-2 pi i
  /// ...), and the twiddles are of the same sign.
  /// @param columns   a multiple of 8
  /// @param in_count  <= n: elements from there on are taken as 0 and not read
  /// @param work      2 x n x 16 floats; in == out is allowed, else they must not overlap
  void (*run)(const LaneFftPasses& passes, bool forward, const float* in, std::ptrdiff_t in_stride,
              std::ptrdiff_t in_count, float* out, std::ptrdiff_t out_stride,
              std::ptrdiff_t columns, float* work);
  /// Real rows of n contiguous floats to n / 2 + 1 complex numbers each, forward. Of `out` as many
  /// more are overwritten as make 8.
  /// @param work  4 x n x 16 floats
  void (*forward_rows)(const LaneFftPasses& passes, const float* in, std::ptrdiff_t in_stride,
                       std::ptrdiff_t rows, float* out, std::ptrdiff_t out_stride, float* work);
  /// The way back, unnormalised. Imaginary parts at frequency 0 and n / 2 do not count.
  void (*backward_rows)(const LaneFftPasses& passes, const float* in, std::ptrdiff_t in_stride,
                        std::ptrdiff_t rows, float* out, std::ptrdiff_t out_stride, float* work);
};

}  // namespace mortise
