// SPDX-License-Identifier: GPL-3.0-or-later
// Measured poses as columns.
#include "mortise/runs/quality_columns.hpp"

#include <utility>

namespace mortise {

void set_quality_columns(Run& run, const std::vector<ComplexMetrics>& metrics) {
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

}  // namespace mortise
