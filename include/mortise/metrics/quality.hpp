// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// DockQ and the CAPRI classes: how good a docked pose is, from fnat and two RMSDs.
#pragma once

#include <string_view>

namespace mortise {

/// CAPRI's quality classes, worst first, so that `>=` compares them.
enum class CapriClass { kIncorrect, kAcceptable, kMedium, kHigh };

/// "incorrect", "acceptable", "medium" or "high".
[[nodiscard]] std::string_view to_string(CapriClass quality);

/// The class of CAPRI's table:
///
///   high        fnat >= 0.5 and (L-RMSD <= 1 or i-RMSD <= 1)
///   medium      fnat >= 0.3 and (L-RMSD <= 5 or i-RMSD <= 2)
///   acceptable  fnat >= 0.1 and (L-RMSD <= 10 or i-RMSD <= 4)
///
/// tried from the top; incorrect otherwise. Mendez, Leplae, De Maria, Wodak, Proteins 52 (2003)
/// 51-67, and Lensink, Wodak, Proteins 78 (2010) 3073-3084, Table I. Their rows name both bounds;
/// from the top down, the lower ones suffice.
/// @param ligand_rmsd, interface_rmsd  angstrom
[[nodiscard]] CapriClass capri_class(double fnat, double ligand_rmsd, double interface_rmsd);

/// (fnat + 1 / (1 + (i-RMSD / 1.5)^2) + 1 / (1 + (L-RMSD / 8.5)^2)) / 3, in [0, 1], 1 is the
/// reference itself. Basu, Wallner, PLoS ONE 11 (2016) e0161879, Eq. 1; unchanged in DockQ 2
/// (Mirabello, Wallner, Bioinformatics 40 (2024) btae586).
/// @param ligand_rmsd, interface_rmsd  angstrom
[[nodiscard]] double dockq_score(double fnat, double ligand_rmsd, double interface_rmsd);

/// DockQ's own bands: acceptable from 0.23, medium from 0.49, high from 0.80 (Basu, Wallner 2016,
/// Table 1).
[[nodiscard]] CapriClass dockq_class(double dockq);

inline constexpr double kHitInterfaceRmsd =
    2.5;  ///< angstrom: at or below, docking benchmarks count a hit

/// What one pose of the moving body is worth against a reference complex.
struct ComplexMetrics {
  double interface_rmsd = 0.0;  ///< i-RMSD, angstrom
  double ligand_rmsd = 0.0;     ///< L-RMSD, angstrom
  double fnat = 0.0;            ///< fraction of the reference's residue contacts that the pose has
  double fnonnat = 0.0;  ///< fraction of the pose's residue contacts that the reference has not
  double dockq = 0.0;
  CapriClass capri = CapriClass::kIncorrect;

  [[nodiscard]] bool is_hit() const noexcept { return interface_rmsd <= kHitInterfaceRmsd; }
  [[nodiscard]] bool is_acceptable() const noexcept { return capri >= CapriClass::kAcceptable; }
  /// i-RMSD <= 4 or L-RMSD <= 10 angstrom: CAPRI's acceptable without its condition on fnat.
  [[nodiscard]] bool is_acceptable_by_rmsd() const noexcept {
    return interface_rmsd <= 4.0 || ligand_rmsd <= 10.0;
  }
};

}  // namespace mortise
