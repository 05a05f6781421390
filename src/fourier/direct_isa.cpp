// SPDX-License-Identifier: GPL-3.0-or-later
// The inner loop of the direct sum; compiled once per instruction set (see cmake/MortiseIsa.cmake).
#include "fourier/direct_isa.hpp"

#include "core/isa_vector.hpp"

namespace mortise::MORTISE_ISA {
extern const DirectTable kDirectTable;

namespace {

constexpr int kLanes = kVectorBytes / 8;
using Vector __attribute__((vector_size(kVectorBytes))) = double;

void add_four(const double* outer_real, const double* outer_imag, const double* tables,
              std::ptrdiff_t length, double* sum) {
  const double a0 = outer_real[0], a1 = outer_real[1], a2 = outer_real[2], a3 = outer_real[3];
  const double b0 = outer_imag[0], b1 = outer_imag[1], b2 = outer_imag[2], b3 = outer_imag[3];
  for (std::ptrdiff_t m = 0; m < length; m += kLanes) {
    const double* p = tables + m;
    Vector real = load<Vector>(sum + m), imag = load<Vector>(sum + length + m);
    Vector x = load<Vector>(p), y = load<Vector>(p + length);
    real = real + a0 * x - b0 * y;
    imag = imag + a0 * y + b0 * x;
    x = load<Vector>(p + 2 * length), y = load<Vector>(p + 3 * length);
    real = real + a1 * x - b1 * y;
    imag = imag + a1 * y + b1 * x;
    x = load<Vector>(p + 4 * length), y = load<Vector>(p + 5 * length);
    real = real + a2 * x - b2 * y;
    imag = imag + a2 * y + b2 * x;
    x = load<Vector>(p + 6 * length), y = load<Vector>(p + 7 * length);
    real = real + a3 * x - b3 * y;
    imag = imag + a3 * y + b3 * x;
    store(sum + m, real);
    store(sum + length + m, imag);
  }
}

}  // namespace

const DirectTable kDirectTable = {add_four};

}  // namespace mortise::MORTISE_ISA
