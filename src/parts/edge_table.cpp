// SPDX-License-Identifier: GPL-3.0-or-later
// Edges by sorting, disjoint sets by path halving.
#include "parts/edge_table.hpp"

#include <algorithm>
#include <cstdlib>
#include <numeric>

namespace mortise::parts {

std::vector<Side> sorted_sides(const Triangles& triangles) {
  // Counting sort by the smaller end, then a sort of the few sides that share it.
  int vertices = 0;
  for (const auto& t : triangles) vertices = std::max({vertices, t[0] + 1, t[1] + 1, t[2] + 1});
  std::vector<std::size_t> start(static_cast<std::size_t>(vertices) + 1, 0);
  const auto each_side = [&](auto&& visit) {
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      for (int k = 0; k < 3; ++k) {
        const int a = triangles[i][static_cast<std::size_t>(k)];
        const int b = triangles[i][static_cast<std::size_t>((k + 1) % 3)];
        visit(std::min(a, b), std::max(a, b), static_cast<int>(i), k);
      }
    }
  };
  each_side([&](int low, int, int, int) { ++start[static_cast<std::size_t>(low) + 1]; });
  std::partial_sum(start.begin(), start.end(), start.begin());
  std::vector<Side> sides(3 * triangles.size());
  std::vector<std::size_t> next(start.begin(), start.end() - (start.empty() ? 0 : 1));
  each_side([&](int low, int high, int triangle, int corner) {
    const std::uint64_t edge =
        (static_cast<std::uint64_t>(low) << 32) | static_cast<unsigned>(high);
    sides[next[static_cast<std::size_t>(low)]++] = {edge, triangle, corner};
  });
  const auto before = [](const Side& a, const Side& b) {
    if (a.edge != b.edge) return a.edge < b.edge;
    return a.triangle != b.triangle ? a.triangle < b.triangle : a.corner < b.corner;
  };
  for (std::size_t v = 0; v + 1 < start.size(); ++v) {
    std::sort(sides.begin() + static_cast<std::ptrdiff_t>(start[v]),
              sides.begin() + static_cast<std::ptrdiff_t>(start[v + 1]), before);
  }
  return sides;
}

std::vector<OpenEdge> open_edges(const Triangles& triangles, const std::vector<Side>& sides) {
  std::vector<OpenEdge> open;
  for_each_edge(sides, [&](std::size_t first, std::size_t last) {
    int surplus = 0;
    for (std::size_t i = first; i < last; ++i)
      surplus += runs_forward(triangles, sides[i]) ? 1 : -1;
    const int low = low_end(sides[first].edge);
    const int high = high_end(sides[first].edge);
    if (surplus > 0) open.push_back({low, high, surplus});
    if (surplus < 0) open.push_back({high, low, -surplus});
  });
  return open;
}

DisjointSets::DisjointSets(std::size_t count) : parent_(count) {
  std::iota(parent_.begin(), parent_.end(), 0);
}

int DisjointSets::find(int i) {
  while (parent_[static_cast<std::size_t>(i)] != i) {
    int& up = parent_[static_cast<std::size_t>(i)];
    up = parent_[static_cast<std::size_t>(up)];
    i = up;
  }
  return i;
}

void DisjointSets::join(int a, int b) {
  a = find(a);
  b = find(b);
  parent_[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
}

std::vector<int> DisjointSets::numbers(int* count) {
  std::vector<int> number(parent_.size(), -1);
  int next = 0;
  for (std::size_t i = 0; i < parent_.size(); ++i) {
    const auto root = static_cast<std::size_t>(find(static_cast<int>(i)));
    if (number[root] < 0) number[root] = next++;
    number[i] = number[root];
  }
  if (count != nullptr) *count = next;
  return number;
}

}  // namespace mortise::parts
