// SPDX-License-Identifier: GPL-3.0-or-later
// The search loop's own inner loops; compiled once per instruction set (see cmake/MortiseIsa.cmake
// for what that forbids here).
#include "search/search_isa.hpp"

namespace mortise::MORTISE_ISA {
extern const SearchTable kSearchTable;

namespace {

template <bool First>
void multiply(const float* __restrict f, const float* __restrict m, std::ptrdiff_t count,
              float* __restrict out) {
  for (std::ptrdiff_t i = 0; i < 2 * count; i += 2) {
    const float re = f[i] * m[i] + f[i + 1] * m[i + 1];
    const float im = f[i + 1] * m[i] - f[i] * m[i + 1];
    out[i] = First ? re : out[i] + re;
    out[i + 1] = First ? im : out[i + 1] + im;
  }
}

void multiply_conjugate(const float* f, const float* m, std::ptrdiff_t count, bool first,
                        float* out) {
  if (first)
    multiply<true>(f, m, count, out);
  else
    multiply<false>(f, m, count, out);
}

void row_maxima(const float* grid, std::ptrdiff_t rows, std::ptrdiff_t stride, float* maxima) {
  for (std::ptrdiff_t r = 0; r < rows; ++r) {
    const float* row = grid + r * stride;
    float lane[16];
    for (int l = 0; l < 16; ++l) lane[l] = row[l];
    for (std::ptrdiff_t k = 16; k < stride; k += 16)
      for (int l = 0; l < 16; ++l) lane[l] = row[k + l] > lane[l] ? row[k + l] : lane[l];
    for (int half = 8; half > 0; half /= 2)
      for (int l = 0; l < half; ++l) lane[l] = lane[l + half] > lane[l] ? lane[l + half] : lane[l];
    maxima[r] = lane[0];
  }
}

}  // namespace

const SearchTable kSearchTable = {multiply_conjugate, row_maxima};

}  // namespace mortise::MORTISE_ISA
