// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Vectors of doubles for sources compiled once per instruction set; to be included by such only.
#pragma once

#if defined(__x86_64__)
#include <immintrin.h>  // nothing but always-inlined wrappers
#endif

#include "core/isa_vector.hpp"

namespace mortise::MORTISE_ISA {
namespace {

constexpr int kLanes = kVectorBytes / 8;

using Lanes __attribute__((vector_size(kVectorBytes))) = double;
using LaneMask __attribute__((vector_size(kVectorBytes))) = long long;

[[gnu::always_inline]] inline Lanes all(double x) { return Lanes{} + x; }
[[gnu::always_inline]] inline Lanes smaller(const Lanes& a, const Lanes& b) {
  return a < b ? a : b;
}
[[gnu::always_inline]] inline Lanes larger(const Lanes& a, const Lanes& b) { return a > b ? a : b; }

/// One bit per lane, lane 0 lowest.
[[gnu::always_inline]] inline unsigned bits(const LaneMask& m) {
#if defined(__AVX512DQ__)
  return _mm512_movepi64_mask(reinterpret_cast<const __m512i&>(m));
#elif defined(__AVX2__)
  return static_cast<unsigned>(_mm256_movemask_pd(reinterpret_cast<const __m256d&>(m)));
#elif defined(__x86_64__)
  return static_cast<unsigned>(_mm_movemask_pd(reinterpret_cast<const __m128d&>(m)));
#else
  unsigned result = 0;
  for (int l = 0; l < kLanes; ++l) result |= (m[l] != 0 ? 1u : 0u) << l;
  return result;
#endif
}

[[gnu::always_inline]] inline Lanes root(const Lanes& v) {
  Lanes result;
#if defined(__AVX512F__)
  // The unmasked form makes gcc 12 warn of an uninitialised value of its own header.
  reinterpret_cast<__m512d&>(result) =
      _mm512_maskz_sqrt_pd(0xff, reinterpret_cast<const __m512d&>(v));
#elif defined(__AVX2__)
  reinterpret_cast<__m256d&>(result) = _mm256_sqrt_pd(reinterpret_cast<const __m256d&>(v));
#elif defined(__x86_64__)
  reinterpret_cast<__m128d&>(result) = _mm_sqrt_pd(reinterpret_cast<const __m128d&>(v));
#else
  for (int l = 0; l < kLanes; ++l) result[l] = __builtin_sqrt(v[l]);
#endif
  return result;
}

[[gnu::always_inline]] inline double sum(const Lanes& v) {
  double total = 0.0;
  for (int l = 0; l < kLanes; ++l) total += v[l];
  return total;
}

struct Lanes3 {
  Lanes x, y, z;
};

/// The lanes from `l` on of three rows of eight.
[[gnu::always_inline]] inline Lanes3 load3(const double (*rows)[8], int l) {
  return {load<Lanes>(rows[0] + l), load<Lanes>(rows[1] + l), load<Lanes>(rows[2] + l)};
}
[[gnu::always_inline]] inline Lanes3 minus(const Lanes3& a, const Lanes3& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
[[gnu::always_inline]] inline Lanes dot(const Lanes3& a, const Lanes3& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
[[gnu::always_inline]] inline Lanes3 cross(const Lanes3& a, const Lanes3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
/// a - t b
[[gnu::always_inline]] inline Lanes3 step(const Lanes3& a, const Lanes& t, const Lanes3& b) {
  return {a.x - t * b.x, a.y - t * b.y, a.z - t * b.z};
}

}  // namespace
}  // namespace mortise::MORTISE_ISA
