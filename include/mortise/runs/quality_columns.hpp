// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Measured poses as metric columns of a run.
#pragma once

#include <vector>

#include "mortise/metrics/quality.hpp"
#include "mortise/store/run_file.hpp"

namespace mortise {

/// Puts interface_rmsd, ligand_rmsd (angstrom), fnat, dockq and capri (0 to 3) into the run, in
/// place of earlier columns of these names.
/// @param metrics  one per pose
void set_quality_columns(Run& run, const std::vector<ComplexMetrics>& metrics);

}  // namespace mortise
