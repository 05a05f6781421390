// SPDX-License-Identifier: GPL-3.0-or-later
// Reads atom records through OpenMM's Python readers; the one place that knows of them.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "molecules/atom_records.hpp"

namespace mortise::molecules {

/// Positions of the records as openmm.app.PDBFile or PDBxFile reads them, 3 x N, angstrom.
/// Records of one residue must be contiguous. Starts the interpreter on first use; thread safe.
/// @throws FileError naming `path` if OpenMM refuses the text, std::runtime_error if there is no
/// OpenMM
[[nodiscard]] Eigen::Matrix3Xd read_positions_with_openmm(const std::string& path,
                                                          const std::vector<AtomRecord>& records,
                                                          Format format);

}  // namespace mortise::molecules
