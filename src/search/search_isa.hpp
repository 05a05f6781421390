// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The search loop's own inner loops, compiled once per instruction set. Types only.
#pragma once

#include <cstddef>

namespace mortise {

struct SearchTable {
  /// out[i] (+)= f[i] conj(m[i]) for `count` complex numbers as (real, imaginary) pairs; `first`
  /// overwrites instead of adding.
  void (*multiply_conjugate)(const float* f, const float* m, std::ptrdiff_t count, bool first,
                             float* out);
  /// Largest value of each of `rows` rows of `stride` floats, a multiple of 16.
  void (*row_maxima)(const float* grid, std::ptrdiff_t rows, std::ptrdiff_t stride, float* maxima);
};

}  // namespace mortise
