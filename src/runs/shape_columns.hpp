// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What the shape score of a pose leaves out, and how it depends on the bodies' size.
#pragma once

#include <cstddef>
#include <vector>

#include "mortise/affinity/channel.hpp"
#include "mortise/runs/search_plan.hpp"

namespace mortise {

struct ShapeColumnsOptions {
  std::size_t count = 100;         ///< best poses described; the others get NaN
  double weight = 1.0;             ///< of the search's score in the poses' column "shape"
  double cutoff = 0.25;            ///< of the search's low-pass, cycles per length unit
  double radius_tolerance = 3e-3;  ///< as of the search
  int threads = 0;                 ///< 0 = all cores; never changes the result
};

/// Columns, in units of the column "shape":
/// - shape_low_pass and shape_spread: of the place where the search found the pose, what the
///   low-pass changed against the exact pair sum, and what the grid did besides; the search's score
///   is within their sum of the exact one (scoring/shape_scores.hpp);
/// - shape_offset_slope: derivative of the low-passed score by an offset of the moving body's
/// radii,
///   per length unit, at the pose as it stands.
/// @param channel  the search's only one
[[nodiscard]] std::vector<MetricColumn> shape_columns(const Channel& channel, const PoseList& poses,
                                                      const std::vector<FoundPose>& found,
                                                      const ShapeColumnsOptions& options);

}  // namespace mortise
