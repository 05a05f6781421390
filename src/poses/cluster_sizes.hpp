// SPDX-License-Identifier: GPL-3.0-or-later
// What the ways of clustering share: options checked, clusters counted and small ones dissolved.
#pragma once

#include <cstddef>

#include "mortise/poses/cluster.hpp"

namespace mortise::detail {

// Throws InputError unless radius >= 0 and min_size >= 1.
void check_cluster_options(double radius, std::size_t min_size);

// Fills in the sizes; clusters below min_size lose their poses, the others are numbered anew.
[[nodiscard]] Clusters counted(Clusters clusters, std::size_t min_size);

}  // namespace mortise::detail
