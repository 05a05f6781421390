// SPDX-License-Identifier: GPL-3.0-or-later
// The inner loop of the direct sum; compiled once per instruction set (see cmake/MortiseIsa.cmake).
#include "fourier/direct_isa.hpp"

namespace mortise::MORTISE_ISA {
extern const DirectTable kDirectTable;

namespace {

#if defined(__AVX512F__)
constexpr int kLanes = 8;
#elif defined(__AVX__)
constexpr int kLanes = 4;
#else
constexpr int kLanes = 2;
#endif
using Vector __attribute__((vector_size(kLanes * sizeof(double)))) = double;

[[gnu::always_inline]] inline Vector load(const double* p) {
  Vector v;
  __builtin_memcpy(&v, p, sizeof v);
  return v;
}

void add_four(const double* outer_real, const double* outer_imag, const double* tables,
              std::ptrdiff_t length, double* sum) {
  const double a0 = outer_real[0], a1 = outer_real[1], a2 = outer_real[2], a3 = outer_real[3];
  const double b0 = outer_imag[0], b1 = outer_imag[1], b2 = outer_imag[2], b3 = outer_imag[3];
  for (std::ptrdiff_t m = 0; m < length; m += kLanes) {
    const double* p = tables + m;
    Vector real = load(sum + m), imag = load(sum + length + m);
    Vector x = load(p), y = load(p + length);
    real = real + a0 * x - b0 * y;
    imag = imag + a0 * y + b0 * x;
    x = load(p + 2 * length), y = load(p + 3 * length);
    real = real + a1 * x - b1 * y;
    imag = imag + a1 * y + b1 * x;
    x = load(p + 4 * length), y = load(p + 5 * length);
    real = real + a2 * x - b2 * y;
    imag = imag + a2 * y + b2 * x;
    x = load(p + 6 * length), y = load(p + 7 * length);
    real = real + a3 * x - b3 * y;
    imag = imag + a3 * y + b3 * x;
    __builtin_memcpy(sum + m, &real, sizeof real);
    __builtin_memcpy(sum + length + m, &imag, sizeof imag);
  }
}

}  // namespace

const DirectTable kDirectTable = {add_four};

}  // namespace mortise::MORTISE_ISA
