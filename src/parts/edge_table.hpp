// SPDX-License-Identifier: GPL-3.0-or-later
// Which triangles meet at each edge.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mortise/parts/triangle_mesh.hpp"

namespace mortise::parts {

using Triangles = std::vector<std::array<int, 3>>;

/// One side of one triangle: the edge from its corner k to its corner k + 1.
struct Side {
  std::uint64_t edge;  ///< both ends, the smaller first
  int triangle;
  int corner;
};

/// All sides, those of one edge together, in a fixed order.
[[nodiscard]] std::vector<Side> sorted_sides(const Triangles& triangles);

/// Whether the side runs from the smaller end to the larger.
[[nodiscard]] inline bool runs_forward(const Triangles& triangles, const Side& side) {
  const auto& t = triangles[static_cast<std::size_t>(side.triangle)];
  return t[static_cast<std::size_t>(side.corner)] <
         t[static_cast<std::size_t>((side.corner + 1) % 3)];
}

[[nodiscard]] inline int low_end(std::uint64_t edge) { return static_cast<int>(edge >> 32); }
[[nodiscard]] inline int high_end(std::uint64_t edge) {
  return static_cast<int>(edge & 0xffffffffU);
}

/// Calls visit(first, last) for the sides of each edge.
template <class Visit>
void for_each_edge(const std::vector<Side>& sides, Visit&& visit) {
  for (std::size_t first = 0; first < sides.size();) {
    std::size_t last = first + 1;
    while (last < sides.size() && sides[last].edge == sides[first].edge) ++last;
    visit(first, last);
    first = last;
  }
}

/// An edge walked `times` more often from `from` to `to` than back: it is open.
struct OpenEdge {
  int from;
  int to;
  int times;
};

[[nodiscard]] std::vector<OpenEdge> open_edges(const Triangles& triangles,
                                               const std::vector<Side>& sides);

/// Sets that are joined one pair at a time.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count);
  [[nodiscard]] int find(int i);
  void join(int a, int b);
  /// A number in [0, number of sets) for each element, by first occurrence.
  [[nodiscard]] std::vector<int> numbers(int* count = nullptr);

 private:
  std::vector<int> parent_;
};

}  // namespace mortise::parts
