// SPDX-License-Identifier: GPL-3.0-or-later
// Inner balls that do not overlap, largest first: the packing of Weller and Zachmann.
#include <queue>
#include <utility>

#include "parts/inner_balls.hpp"

namespace mortise::parts {

std::vector<GridBall> packed_balls(const NodeField& field) {
  constexpr float kCovered = 1e-6F;  // spacings; nearer to a ball than this counts as in it
  // How large a ball about each node may be, so far.
  std::vector<float> room(field.depth);
  using Entry = std::pair<float, std::int64_t>;
  const auto later = [](const Entry& a, const Entry& b) {
    return a.first != b.first ? a.first < b.first : a.second > b.second;
  };
  std::priority_queue<Entry, std::vector<Entry>, decltype(later)> queue(later);
  for (std::int64_t i = 0; i < field.count(); ++i)
    if (room[i] > 0.0F) queue.emplace(room[i], i);
  std::vector<GridBall> balls;
  while (!queue.empty()) {
    const float radius = queue.top().first;  // no structured binding: the lambda below takes it
    const auto i = queue.top().second;
    queue.pop();
    if (room[i] <= 0.0F) continue;
    if (room[i] < radius) {  // it has shrunk since it was queued
      queue.emplace(room[i], i);
      continue;
    }
    const Eigen::Vector3d center = field.node_at(i).cast<double>();
    balls.push_back({center, radius});
    // No room is larger than this radius: a node beyond twice the radius keeps its own.
    for_rows_in(field, {center, 2.0 * radius}, [&](std::int64_t first, std::int64_t last) {
      const Eigen::Vector3d start = field.node_at(first).cast<double>().matrix() - center;
      double along = start.z();
      for (std::int64_t k = first; k <= last; ++k, along += 1.0) {
        if (room[k] <= 0.0F) continue;
        const double beyond = std::sqrt(start.head<2>().squaredNorm() + along * along) - radius;
        if (beyond <= kCovered)
          room[k] = 0.0F;
        else
          room[k] = std::min(room[k], static_cast<float>(beyond));
      }
    });
    room[i] = 0.0F;
  }
  return balls;
}

}  // namespace mortise::parts
