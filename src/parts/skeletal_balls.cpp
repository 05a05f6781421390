// SPDX-License-Identifier: GPL-3.0-or-later
// Inner balls in the order of the medial axis [SD, Alg. 1, step 1].
#include <algorithm>
#include <numeric>

#include "mortise/core/errors.hpp"
#include "parts/inner_balls.hpp"

namespace mortise::parts {
namespace {

// How much of the depth's gradient flows into a node's cell: zero where the depth is smooth, the
// more the wider the angle between the nearest points of the boundary. It stands in for the
// skeletal density [SD, App. A], see docs/math.md.
float inward_flux(const NodeField& field, const Eigen::Array3i& node) {
  const auto at = [&](int x, int y, int z) {
    return (Eigen::Array3i(x, y, z) < 0).any() || (Eigen::Array3i(x, y, z) >= field.size).any()
               ? -1.0F
               : field.depth[field.index(x, y, z)];
  };
  const int x = node.x(), y = node.y(), z = node.z();
  return 6.0F * at(x, y, z) - at(x - 1, y, z) - at(x + 1, y, z) - at(x, y - 1, z) -
         at(x, y + 1, z) - at(x, y, z - 1) - at(x, y, z + 1);
}

std::vector<std::int64_t> medial_order(const NodeField& field) {
  struct Entry {
    float flux, depth;
    std::int64_t node;
  };
  std::vector<Entry> entries;
  for (std::int64_t i = 0; i < field.count(); ++i)
    if (field.depth[i] > 0.0F)
      entries.push_back({inward_flux(field, field.node_at(i)), field.depth[i], i});
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    if (a.flux != b.flux) return a.flux > b.flux;
    if (a.depth != b.depth) return a.depth > b.depth;
    return a.node < b.node;
  });
  std::vector<std::int64_t> order(entries.size());
  std::transform(entries.begin(), entries.end(), order.begin(),
                 [](const Entry& e) { return e.node; });
  return order;
}

}  // namespace

std::vector<GridBall> skeletal_balls(const NodeField& field, double protrusion) {
  constexpr std::uint8_t kCovered = 1, kPopped = 2;
  const std::vector<std::int64_t> order = medial_order(field);
  std::vector<std::uint8_t> state(field.depth.size(), 0);
  auto left = static_cast<std::int64_t>(order.size());
  std::vector<GridBall> balls;
  const auto keep = static_cast<float>(1.0 - protrusion);
  for (const std::int64_t i : order) {
    if (left == 0) break;
    if ((state[i] & kPopped) != 0) continue;
    const Eigen::Vector3d center = field.node_at(i).cast<double>();
    const float radius = field.depth[i];
    balls.push_back({center, radius});
    // A node x' is popped if |x - x'| - (r - r') <= mu r': the paper's |r - r'| would also pop
    // nodes outside the ball, about which larger balls lie.
    for_rows_in(field, balls.back(), [&](std::int64_t first, std::int64_t last) {
      const Eigen::Vector3d start = field.node_at(first).cast<double>().matrix() - center;
      const auto across_sq = static_cast<float>(start.head<2>().squaredNorm());
      auto along = static_cast<float>(start.z());
      for (std::int64_t k = first; k <= last; ++k, along += 1.0F) {
        const float depth = field.depth[k];
        if (depth <= 0.0F) continue;
        const float within = radius - keep * depth;
        const bool pop = within >= 0.0F && across_sq + along * along <= within * within;
        left -= (state[k] & kCovered) == 0 ? 1 : 0;
        state[k] |= pop ? kCovered | kPopped : kCovered;
      }
    });
    if ((state[i] & kCovered) == 0) {  // a radius lost in rounding
      state[i] |= kCovered;
      --left;
    }
  }
  return balls;
}

}  // namespace mortise::parts
