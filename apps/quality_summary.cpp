// SPDX-License-Identifier: GPL-3.0-or-later
// First ranks and best values of measured poses.
#include "quality_summary.hpp"

#include <algorithm>
#include <utility>

#include "mortise/report/interface_columns.hpp"

namespace mortise::app {

QualitySummary summarise(const std::vector<ComplexMetrics>& metrics) {
  QualitySummary summary;
  if (metrics.empty()) return summary;
  summary.best = metrics.front();
  int rank = 0;
  for (const ComplexMetrics& m : metrics) {
    ++rank;
    const auto note = [rank](std::optional<int>& first, bool good) {
      if (good && !first) first = rank;
    };
    note(summary.first_acceptable, m.is_acceptable());
    note(summary.first_acceptable_by_rmsd, m.is_acceptable_by_rmsd());
    note(summary.first_medium, m.capri >= CapriClass::kMedium);
    note(summary.first_high, m.capri >= CapriClass::kHigh);
    note(summary.first_hit, m.is_hit());
    ComplexMetrics& best = summary.best;
    best.interface_rmsd = std::min(best.interface_rmsd, m.interface_rmsd);
    best.ligand_rmsd = std::min(best.ligand_rmsd, m.ligand_rmsd);
    best.fnat = std::max(best.fnat, m.fnat);
    best.fnonnat = std::min(best.fnonnat, m.fnonnat);
    best.dockq = std::max(best.dockq, m.dockq);
    best.capri = std::max(best.capri, m.capri);
  }
  return summary;
}

nlohmann::ordered_json to_json(const QualitySummary& summary) {
  using Json = nlohmann::ordered_json;
  const auto rank = [](const std::optional<int>& value) { return value ? Json(*value) : Json(); };
  return {{"first_acceptable", rank(summary.first_acceptable)},
          {"first_medium", rank(summary.first_medium)},
          {"first_high", rank(summary.first_high)},
          {"first_irmsd_2_5", rank(summary.first_hit)},
          {"first_within_2_percent", nullptr},  // of parts
          {"first_acceptable_by_rmsd", rank(summary.first_acceptable_by_rmsd)},
          {"best_interface_rmsd", summary.best.interface_rmsd},
          {"best_ligand_rmsd", summary.best.ligand_rmsd},
          {"best_fnat", summary.best.fnat},
          {"best_dockq", summary.best.dockq}};
}

void set_metrics(Run& run, const std::vector<ComplexMetrics>& metrics) {
  std::vector<MetricColumn> columns;
  const auto set = [&](const char* name, auto value) {
    MetricColumn column{name, {}};
    for (const ComplexMetrics& m : metrics) column.values.push_back(value(m));
    columns.push_back(std::move(column));
  };
  set("interface_rmsd", [](const ComplexMetrics& m) { return m.interface_rmsd; });
  set("ligand_rmsd", [](const ComplexMetrics& m) { return m.ligand_rmsd; });
  set("fnat", [](const ComplexMetrics& m) { return m.fnat; });
  set("dockq", [](const ComplexMetrics& m) { return m.dockq; });
  set("capri", [](const ComplexMetrics& m) { return static_cast<double>(m.capri); });
  set_metric_columns(run, std::move(columns));
}

}  // namespace mortise::app
