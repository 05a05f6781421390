// SPDX-License-Identifier: GPL-3.0-or-later
// What a ranked list of poses is worth: at which rank the first good one comes, and the best
// values.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "mortise/metrics/quality.hpp"
#include "mortise/store/run_file.hpp"

namespace mortise::app {

/// Ranks count from 1; none = no such pose.
struct QualitySummary {
  std::optional<int> first_acceptable;          ///< CAPRI acceptable or better
  std::optional<int> first_acceptable_by_rmsd;  ///< i-RMSD <= 4 or L-RMSD <= 10 angstrom
  std::optional<int> first_medium;
  std::optional<int> first_high;
  std::optional<int> first_hit;  ///< i-RMSD <= 2.5 angstrom
  ComplexMetrics best;           ///< each value the best of any pose; absent without poses
};

/// @param metrics  in rank order, at least one
[[nodiscard]] QualitySummary summarise(const std::vector<ComplexMetrics>& metrics);

/// The summary under the keys that `evaluate --json` prints.
[[nodiscard]] nlohmann::ordered_json to_json(const QualitySummary& summary);

/// Puts a column into the run, in place of an earlier one of its name.
void set_metric(Run& run, MetricColumn column);

/// Puts the metrics into the run as columns, in place of earlier ones of their names.
void set_metrics(Run& run, const std::vector<ComplexMetrics>& metrics);

}  // namespace mortise::app
