// SPDX-License-Identifier: GPL-3.0-or-later
// The inner loop of the direct sum; compiled once per instruction set (see cmake/MortiseIsa.cmake).
#include "fourier/direct_isa.hpp"

namespace mortise::MORTISE_ISA {
extern const DirectTable kDirectTable;

namespace {

void add_four(const double* outer_real, const double* outer_imag, const double* tables,
              std::ptrdiff_t length, double* sum) {
  const double a0 = outer_real[0], a1 = outer_real[1], a2 = outer_real[2], a3 = outer_real[3];
  const double b0 = outer_imag[0], b1 = outer_imag[1], b2 = outer_imag[2], b3 = outer_imag[3];
  const double* __restrict const r0 = tables;
  const double* __restrict const r1 = tables + 2 * length;
  const double* __restrict const r2 = tables + 4 * length;
  const double* __restrict const r3 = tables + 6 * length;
  double* __restrict const real = sum;
  double* __restrict const imag = sum + length;
  for (std::ptrdiff_t m = 0; m < length; ++m) {
    const double i0 = r0[length + m], i1 = r1[length + m], i2 = r2[length + m], i3 = r3[length + m];
    real[m] +=
        a0 * r0[m] - b0 * i0 + a1 * r1[m] - b1 * i1 + a2 * r2[m] - b2 * i2 + a3 * r3[m] - b3 * i3;
    imag[m] +=
        a0 * i0 + b0 * r0[m] + a1 * i1 + b1 * r1[m] + a2 * i2 + b2 * r2[m] + a3 * i3 + b3 * r3[m];
  }
}

}  // namespace

const DirectTable kDirectTable = {add_four};

}  // namespace mortise::MORTISE_ISA
