// SPDX-License-Identifier: GPL-3.0-or-later
// Finding pairs of atoms by the cell list of the fixed body.
#include "metrics/near_pairs.hpp"

#include <algorithm>

namespace mortise::detail {

NearPairs near_pairs(const PointGrid& fixed, Eigen::Index fixed_count,
                     const Eigen::Matrix3Xd& moving) {
  NearPairs out;
  std::vector<std::int32_t> counts(static_cast<std::size_t>(fixed_count) + 1, 0);
  for (Eigen::Index m = 0; m < moving.cols(); ++m) {
    const std::size_t first = out.moving.partners.size();
    fixed.for_each_near(moving.col(m), [&](std::int32_t f) { out.moving.partners.push_back(f); });
    if (out.moving.partners.size() == first) continue;
    std::sort(out.moving.partners.begin() + static_cast<std::ptrdiff_t>(first),
              out.moving.partners.end());
    out.moving.atoms.push_back(static_cast<std::int32_t>(m));
    out.moving.first.push_back(static_cast<std::int32_t>(first));
    for (std::size_t k = first; k < out.moving.partners.size(); ++k)
      ++counts[out.moving.partners[k]];
  }
  out.moving.first.push_back(static_cast<std::int32_t>(out.moving.partners.size()));
  // The same pairs by fixed atom; `counts` becomes where each atom's next partner goes.
  std::int32_t total = 0;
  for (Eigen::Index f = 0; f < fixed_count; ++f) {
    const std::int32_t count = counts[f];
    counts[f] = total;
    if (count == 0) continue;
    out.fixed.atoms.push_back(static_cast<std::int32_t>(f));
    out.fixed.first.push_back(total);
    total += count;
  }
  out.fixed.first.push_back(total);
  out.fixed.partners.resize(static_cast<std::size_t>(total));
  for (std::size_t a = 0; a < out.moving.atoms.size(); ++a)
    for (std::int32_t k = out.moving.first[a]; k < out.moving.first[a + 1]; ++k)
      out.fixed.partners[counts[out.moving.partners[k]]++] = out.moving.atoms[a];
  return out;
}

}  // namespace mortise::detail
