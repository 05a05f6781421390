// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The truncated sum of the gap function, compiled once per instruction set. Types only.
#pragma once

#include <cstddef>

namespace mortise {

inline constexpr int kStencil = 4;     ///< samples per axis that one frequency is interpolated from
inline constexpr int kPieceTerms = 7;  ///< coefficients per piece of the interpolation kernel
inline constexpr int kModeBlock = 32;  ///< modes are summed in blocks of this many

/// Everything one sum over modes needs.
struct GapJob {
  // The modes, each standing for itself and its opposite: integer frequency and coefficient.
  const float *kx, *ky, *kz, *real, *imag;
  std::ptrdiff_t count;  ///< a multiple of kModeBlock; padded with zero coefficients
  // The moving body's spectrum: sample (x, y, z) at table + (x * stride_x + y * stride_y + z * 4),
  // as (re, im) of (x, y, z) and of (x, y + 1, z).
  const float* table;
  std::ptrdiff_t stride_x, stride_y;
  // Coefficients of z^6 .. z^0: 4 values, then their 4 derivatives, at [term * 8]; 64-byte aligned.
  const float* pieces;
  float turn[9];         ///< row-major: k to samples of the moving spectrum
  float centre;          ///< sample index of frequency 0
  float translation[3];  ///< t / L
};

/// Sums over the modes: value, sum k Im(P conj G) (3), sum u x Re(P conj grad G) (3), with u and
/// the gradient in samples, P = coefficient exp(2 pi i k.t / L).
struct GapSums {
  double value, translation[3], rotation[3];
};

struct GapTable {
  void (*sum)(const GapJob& job, GapSums* sums);
  /// Only the value, and the sum of |G|^2 over the modes (one of each pair).
  void (*probe)(const GapJob& job, double* value, double* energy);
};

}  // namespace mortise
