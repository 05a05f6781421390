// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What the spreading loops, compiled once per instruction set, take and offer. Types only.
#pragma once

#include <cstddef>
#include <cstdint>

namespace mortise {

inline constexpr int kMinSpreadWidth = 2;
inline constexpr int kMaxSpreadWidth = 16;

/// Everything about grid and kernel that spreading one point needs.
template <class Real>
struct SpreadJob {
  int width;                 ///< cells per axis one point touches
  int degree;                ///< of the polynomials
  const Real* coefficients;  ///< (degree + 1) x padded width, highest power first; 64-byte aligned
  const std::ptrdiff_t*
      offsets[3];  ///< axes 0 .. D-2: offset in Reals of cell i, wrapped, i < size + width
  Real* grid;
};

/// One point in grid terms: first cell per axis and where in [-1, 1] of its cell the kernel's
/// pieces are evaluated.
template <class Real>
struct SpreadPoints {
  const std::int32_t* start;  ///< D per point
  const Real* fraction;       ///< D per point
  const Real* weights;        ///< one per point, or (real, imaginary) pairs
  const std::int32_t* order;  ///< which points, in which order; null = all in order
  std::ptrdiff_t count;
};

template <class Real>
struct SpreadTable {
  /// Width as stored: pieces past `width` are zero polynomials, and their cells receive zeros.
  int (*padded_width)(int width);
  /// Fills start and fraction of `count` points of `dim` coordinates each, `stride` doubles apart;
  /// false if one is not finite.
  bool (*prepare)(int dim, const double* points, std::ptrdiff_t stride, std::ptrdiff_t count,
                  const double* inverse_box, const std::int32_t* size, int width,
                  std::int32_t* start, Real* fraction);
  /// Adds the points to the grid: [dimension - 3][complex weights].
  void (*spread[2][2])(const SpreadJob<Real>& job, const SpreadPoints<Real>& points);
};

/// Both precisions of one instruction set.
struct SpreadTables {
  SpreadTable<float> single_precision;
  SpreadTable<double> double_precision;
};

}  // namespace mortise
