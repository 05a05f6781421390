// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The inner loop of the direct sum, compiled once per instruction set. Types only.
#pragma once

#include <cstddef>

namespace mortise {

struct DirectTable {
  /// sum[m] += Sum_i outer_i table_i[m] for m < length, a multiple of 8, and four points i; the
  /// tables lie one after the other, real and imaginary parts apart (2 x length doubles per point),
  /// as do the two halves of sum.
  void (*add_four)(const double* outer_real, const double* outer_imag, const double* tables,
                   std::ptrdiff_t length, double* sum);
};

}  // namespace mortise
