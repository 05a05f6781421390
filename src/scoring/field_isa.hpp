// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Cubic interpolation of maps at many points, compiled once per instruction set. Types only.
#pragma once

#include <cstddef>
#include <cstdint>

namespace mortise {

/// Maps on one grid, lengths in grid steps, and what each counts.
struct FieldMaps {
  const float* values;         ///< maps x nx x ny x nz
  const std::uint8_t* nearby;  ///< nx x ny x nz: 0 = every value that cell needs is 0
  std::ptrdiff_t size[3];      ///< >= 4
  std::ptrdiff_t shape;        ///< which map is the shape's
  double contact_factor;       ///< of the points' maps of their types
  double shape_factor;         ///< of the shape's map, beside the points' weights
};

/// A body's points: each feels the map of its type, if that is >= 0, and the shape's.
struct FieldPoints {
  const double *x, *y, *z;  ///< from the body's centre, length unit
  const int* types;
  const double* weights;
  std::ptrdiff_t count;
};

struct FieldTable {
  /// Sum over the body turned by `rotation` (row major, times 1 / grid step) with its centre at
  /// `centre`, from grid point 0: out = value, its gradient by the centre (3), torque about it (3);
  /// all in grid steps.
  void (*evaluate)(const FieldMaps& maps, const FieldPoints& points, const double* rotation,
                   const double* centre, double* out);
};

}  // namespace mortise
