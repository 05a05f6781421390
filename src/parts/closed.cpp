// SPDX-License-Identifier: GPL-3.0-or-later
// Counts each edge's uses one way and the other.
#include "parts/closed.hpp"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace mortise {
namespace {

// Per vertex the first one at the same place.
std::vector<int> first_at_place(const Eigen::Matrix3Xd& vertices) {
  std::vector<int> order(static_cast<std::size_t>(vertices.cols()));
  std::iota(order.begin(), order.end(), 0);
  const auto before = [&](int a, int b) {
    for (int d = 0; d < 3; ++d)
      if (vertices(d, a) != vertices(d, b)) return vertices(d, a) < vertices(d, b);
    return false;
  };
  std::sort(order.begin(), order.end(), before);
  std::vector<int> first(order.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    first[order[i]] = i > 0 && !before(order[i - 1], order[i]) ? first[order[i - 1]] : order[i];
  return first;
}

}  // namespace

bool is_closed(const TriangleMesh& mesh) {
  const std::vector<int> first = first_at_place(mesh.vertices);
  std::vector<std::pair<std::uint64_t, int>> uses;  // edge by its ends, +1 or -1
  uses.reserve(3 * static_cast<std::size_t>(mesh.size()));
  for (Eigen::Index t = 0; t < mesh.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const int a = first[mesh.triangles(k, t)], b = first[mesh.triangles((k + 1) % 3, t)];
      if (a == b) continue;
      const auto low = static_cast<std::uint64_t>(std::min(a, b));
      const auto high = static_cast<std::uint64_t>(std::max(a, b));
      uses.emplace_back(low << 32 | high, a < b ? 1 : -1);
    }
  std::sort(uses.begin(), uses.end());
  for (std::size_t i = 0; i < uses.size();) {
    int balance = 0;
    const std::uint64_t edge = uses[i].first;
    for (; i < uses.size() && uses[i].first == edge; ++i) balance += uses[i].second;
    if (balance != 0) return false;
  }
  return true;
}

}  // namespace mortise
