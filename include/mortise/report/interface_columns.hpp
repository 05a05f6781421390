// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Interface descriptions of poses as metric columns of a run.
#pragma once

#include <cstddef>
#include <vector>

#include "mortise/core/pose.hpp"
#include "mortise/metrics/interface.hpp"
#include "mortise/store/run_file.hpp"

namespace mortise {

/// Columns interface_area, buried_area (square angstrom), contacts (pairs of residues),
/// hydrogen_bonds, clashes and sc, one value per pose of a run.
/// @param descriptions  of the poses `chosen`, in their order
/// @param chosen        indices of poses; all others get NaN
/// @param poses         how many the run has
/// @throws InputError if the counts differ or an index is not below `poses`
[[nodiscard]] std::vector<MetricColumn> interface_columns(
    const std::vector<InterfaceDescription>& descriptions, const std::vector<std::size_t>& chosen,
    std::size_t poses);

/// The same for the best `count` poses (all, if there are fewer), described here, each by one of
/// the threads. @param threads  0 = all cores; never changes the result
[[nodiscard]] std::vector<MetricColumn> interface_columns(const MolecularInterface& interface,
                                                          const PoseList& poses, std::size_t count,
                                                          int threads = 0);

}  // namespace mortise
