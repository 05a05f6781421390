// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Maps in bricks: filled, and read at many points. Compiled once per instruction set. Types only.
///
/// A brick holds 4 x 4 x 4 grid points of every map, those around 3 x 3 x 3 cells: whatever a point
/// in one of these cells reads of a map lies in 128 bytes. Values are the upper halves of floats.
#pragma once

#include <cstddef>
#include <cstdint>

namespace mortise {

inline constexpr int kBrickSide = 4;                ///< grid points
inline constexpr int kBrickCells = kBrickSide - 1;  ///< cells along an axis
inline constexpr int kBrickPoints = kBrickSide * kBrickSide * kBrickSide;
inline constexpr int kPointGroup = 16;  ///< points that are looked up together

struct FieldMaps {
  const std::uint16_t* values;  ///< bricks x maps x 4 x 4 x 4, and one more value; brick 0 is 0
  /// Where each block of 3 x 3 x 3 cells has its brick in `values`; <= 0: minus the number of
  /// blocks along the longest axis to the nearest one that has a brick.
  const std::int32_t* blocks;
  std::int32_t size[3];  ///< blocks
  std::int32_t types;    ///< maps of types; those of shapes follow
};

/// A body's points in groups of 16 near each other. What has no weight fills up the last group.
struct FieldPoints {
  const float *x, *y, *z;                                  ///< from the body's centre, length unit
  const std::int32_t* types;                               ///< >= 0
  const float* contact_weights;                            ///< of the map of the type
  const float* shape_weights;                              ///< shapes x count: of each shape's map
  std::ptrdiff_t count;                                    ///< a multiple of 16
  std::ptrdiff_t shapes;                                   ///< 0 = contacts alone
  const float *group_x, *group_y, *group_z, *group_reach;  ///< balls around the groups
  float steps;                                             ///< grid steps in a length unit
};

/// What a fixed body's points add to maps, at distances in the length unit.
struct FieldSources {
  const float *x, *y, *z;     ///< from grid point 0, length unit
  const std::int32_t* types;  ///< rows of the potential, or tables of the shape
  const float* weights;       ///< of the shape; unused by contacts
};

struct FieldTable {
  /// Sum over the body turned by `rotation` (row major, times 1 / grid step) with its centre at
  /// `centre`, from grid point 0, grid steps.
  double (*value)(const FieldMaps& maps, const FieldPoints& points, const float* rotation,
                  const float* centre);
  /// The same with its derivatives: out = value, its gradient by the centre (3), torque about it
  /// (3); all in grid steps.
  void (*slope)(const FieldMaps& maps, const FieldPoints& points, const float* rotation,
                const float* centre, double* out);
  /// Contact potentials of `count` chosen sources at 4 x 4 x 4 grid points from `corner`: `types`
  /// maps of 64 values. near, far: types x types tables, row of the source first.
  /// @param work  types x 2 x 64 floats, overwritten
  void (*contacts)(const FieldSources& sources, const std::int32_t* chosen, std::ptrdiff_t count,
                   const float* corner, float spacing, const float* near, const float* far,
                   std::ptrdiff_t types, float* work, float* out);
  /// Sum of weight table(d^2) of the chosen sources at the same grid points: 64 values. Tables have
  /// `entries` values at d^2 = i range_sq / (entries - 1) and stand one after the other.
  void (*shape)(const FieldSources& sources, const std::int32_t* chosen, std::ptrdiff_t count,
                const float* corner, float spacing, const float* tables, std::ptrdiff_t entries,
                float range_sq, float* out);
  /// 4 x 4 x 4 values, those of a row side by side, into a brick.
  void (*pack)(const float* from, std::ptrdiff_t plane, std::ptrdiff_t row, std::uint16_t* brick);
};

}  // namespace mortise
