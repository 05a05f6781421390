// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A fixed body's maps in bricks, made.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "mortise/scoring/score_maps.hpp"
#include "scoring/field_isa.hpp"

namespace mortise::detail {

struct MapsLayout {
  std::array<int, 3> size;  ///< blocks of 3 x 3 x 3 cells
  Eigen::Vector3d low;      ///< grid point 0
  double spacing;
};

struct FilledMaps {
  std::vector<std::int32_t> blocks;   ///< FieldMaps::blocks
  std::vector<std::uint16_t> values;  ///< FieldMaps::values
};

/// @param shape  null = no maps of the shape
/// @throws InputError if the maps would have more than 2^31 values
[[nodiscard]] FilledMaps fill_maps(const FieldTable& table, const MapsLayout& layout,
                                   const TypedPoints& fixed, const ContactPotential& potential,
                                   const ShapeTerms* shape, int threads);

}  // namespace mortise::detail
