// SPDX-License-Identifier: GPL-3.0-or-later
// Sizes of clusters, and those too small taken out.
#include "poses/cluster_sizes.hpp"

#include <string>
#include <utility>
#include <vector>

#include "mortise/core/errors.hpp"

namespace mortise::detail {

void check_cluster_options(double radius, std::size_t min_size) {
  if (!(radius >= 0.0))
    throw InputError("cluster: radius must be >= 0, got " + std::to_string(radius));
  if (min_size < 1) throw InputError("cluster: min_size must be >= 1, got 0");
}

Clusters counted(Clusters clusters, std::size_t min_size) {
  std::vector<std::size_t> sizes(clusters.founders.size(), 0);
  for (const int cluster : clusters.cluster_of)
    if (cluster >= 0) ++sizes[cluster];
  std::vector<int> number(sizes.size(), -1);
  Clusters kept;
  for (std::size_t c = 0; c < sizes.size(); ++c) {
    if (sizes[c] < min_size) continue;
    number[c] = static_cast<int>(kept.founders.size());
    kept.founders.push_back(clusters.founders[c]);
    kept.sizes.push_back(sizes[c]);
  }
  kept.cluster_of = std::move(clusters.cluster_of);
  for (int& cluster : kept.cluster_of)
    if (cluster >= 0) cluster = number[cluster];
  return kept;
}

}  // namespace mortise::detail
