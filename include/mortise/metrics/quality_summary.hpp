// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What a ranked list of poses is worth: at which rank the first good one comes, and the best
/// values.
#pragma once

#include <optional>
#include <vector>

#include "mortise/metrics/quality.hpp"

namespace mortise {

/// Ranks count from 1; none = no such pose.
struct QualitySummary {
  std::optional<int> first_acceptable;          ///< CAPRI acceptable or better
  std::optional<int> first_acceptable_by_rmsd;  ///< i-RMSD <= 4 or L-RMSD <= 10 angstrom
  std::optional<int> first_medium;
  std::optional<int> first_high;
  std::optional<int> first_hit;  ///< i-RMSD <= 2.5 angstrom
  ComplexMetrics best;           ///< each value the best of any pose; absent without poses
};

/// @param metrics  in rank order
[[nodiscard]] QualitySummary summarise(const std::vector<ComplexMetrics>& metrics);

}  // namespace mortise
