// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The widest vectors of the instruction set that a source is compiled for; to be included only by
/// sources compiled once per instruction set.
#pragma once

namespace mortise::MORTISE_ISA {
namespace {

#if defined(__AVX512F__)
constexpr int kVectorBytes = 64;
#elif defined(__AVX2__)
constexpr int kVectorBytes = 32;
#else
constexpr int kVectorBytes = 16;
#endif

/// A vector from unaligned memory, and back.
template <class V, class Value>
[[gnu::always_inline]] inline V load(const Value* p) {
  V v;
  __builtin_memcpy(&v, p, sizeof v);
  return v;
}
template <class V, class Value>
[[gnu::always_inline]] inline void store(Value* p, const V& v) {
  __builtin_memcpy(p, &v, sizeof v);
}

}  // namespace
}  // namespace mortise::MORTISE_ISA
