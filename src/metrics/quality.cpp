// SPDX-License-Identifier: GPL-3.0-or-later
// The tables behind DockQ and the CAPRI classes.
#include "mortise/metrics/quality.hpp"

namespace mortise {

std::string_view to_string(CapriClass quality) {
  switch (quality) {
    case CapriClass::kIncorrect:
      return "incorrect";
    case CapriClass::kAcceptable:
      return "acceptable";
    case CapriClass::kMedium:
      return "medium";
    case CapriClass::kHigh:
      return "high";
  }
  return "unknown";
}

CapriClass capri_class(double fnat, double ligand_rmsd, double interface_rmsd) {
  if (fnat >= 0.5 && (ligand_rmsd <= 1.0 || interface_rmsd <= 1.0)) return CapriClass::kHigh;
  if (fnat >= 0.3 && (ligand_rmsd <= 5.0 || interface_rmsd <= 2.0)) return CapriClass::kMedium;
  if (fnat >= 0.1 && (ligand_rmsd <= 10.0 || interface_rmsd <= 4.0)) return CapriClass::kAcceptable;
  return CapriClass::kIncorrect;
}

double dockq_score(double fnat, double ligand_rmsd, double interface_rmsd) {
  const double i = interface_rmsd / 1.5;
  const double l = ligand_rmsd / 8.5;
  return (fnat + 1.0 / (1.0 + i * i) + 1.0 / (1.0 + l * l)) / 3.0;
}

CapriClass dockq_class(double dockq) {
  if (dockq >= 0.80) return CapriClass::kHigh;
  if (dockq >= 0.49) return CapriClass::kMedium;
  if (dockq >= 0.23) return CapriClass::kAcceptable;
  return CapriClass::kIncorrect;
}

}  // namespace mortise
