// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A part as a complex density on a grid: what its assembly energy is made from.
#pragma once

#include "mortise/collision/body_density.hpp"
#include "mortise/parts/mesh_solid.hpp"
#include "mortise/parts/solid.hpp"

namespace mortise {

struct PartFieldOptions {
  int grid = 128;          ///< nodes along the longest side of the part's box and its skin; >= 8
  double thickness = 0.0;  ///< skin outside the part, length unit; 0 = default_thickness(solid)
  double penalty = 3.0;    ///< p, what overlap costs against what fit gains; > 0
  int threads = 0;         ///< 0 = all cores; never changes the result
};

/// 0.15 of the longest side. Give both parts of a pair the smaller one's.
[[nodiscard]] double default_thickness(const Solid& solid);

/// The double skin from signed distances d: i (skin(d) - p core(d)) [SD, Eq. 51], with core a ramp
/// from 0 at d = 0 to 1 one grid step inside, skin a raised cosine over 0 < d < thickness. Then Re
/// rho_1 rho_2 pays p for skin on core, costs p^2 for core on core and 1 for skin on skin.
/// @throws InputError if an option is out of range
[[nodiscard]] BodyDensity double_skin_field(const Solid& solid,
                                            const PartFieldOptions& options = {});

struct SkeletalFieldOptions {
  int grid = 128;        ///< nodes along the longest side of the part's box and its margin; >= 8
  double margin = 0.0;   ///< of space around the part, length unit; 0 = default_thickness(solid)
  double sigma = 0.5;    ///< see SkeletalDensityOptions::thickness: smaller is sharper
  double penalty = 3.0;  ///< p, lambda_2 / lambda_1 [HA, Sec. 2.3]; > 0
  int threads = 0;       ///< 0 = all cores; never changes the result
};

/// The skeletal density on a grid [HA, Eq. 2-3], brought to zero by a raised cosine over the outer
/// half of the margin, for it falls off slowly outside. A complex density: two real sums.
/// @throws InputError if an option is out of range
[[nodiscard]] BodyDensity skeletal_field(const MeshSolid& solid,
                                         const SkeletalFieldOptions& options = {});

}  // namespace mortise
