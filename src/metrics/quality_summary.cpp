// SPDX-License-Identifier: GPL-3.0-or-later
// First ranks and best values of measured poses.
#include "mortise/metrics/quality_summary.hpp"

#include <algorithm>

namespace mortise {

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

}  // namespace mortise
