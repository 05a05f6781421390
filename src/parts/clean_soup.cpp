// SPDX-License-Identifier: GPL-3.0-or-later
// Point merging by hashing, triangles without area by flipping edges.
#include "parts/clean_soup.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <unordered_map>

#include "core/cell_hash.hpp"

namespace mortise::parts {
namespace {

constexpr double kFlat = 1e-12;  ///< height of a triangle without area, part of the diagonal

std::uint64_t mixed(std::uint64_t h) {
  h ^= h >> 31;
  h *= 0x9e3779b97f4a7c15ULL;
  return h ^ (h >> 29);
}

std::uint64_t hash_of(const Eigen::Vector3d& p) {
  std::uint64_t h = 0;
  for (int i = 0; i < 3; ++i) h = mixed(h ^ std::bit_cast<std::uint64_t>(p(i) + 0.0));  // -0 is 0
  return h;
}

/// Replaces each corner v by image[v].
void renumber(Triangles& triangles, const std::vector<int>& image) {
  for (auto& t : triangles) {
    for (int& v : t) v = image[static_cast<std::size_t>(v)];
  }
}

/// The corners in an order that both ways round share, and whether the triangle goes the other way.
std::pair<std::array<int, 3>, bool> canonical(std::array<int, 3> t) {
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  const bool turned = t[1] > t[2];
  if (turned) std::swap(t[1], t[2]);
  return {t, turned};
}

}  // namespace

long merge_equal_points(Surface& surface) {
  const std::size_t count = surface.points.size();
  const std::size_t slots = std::bit_ceil(2 * count + 2);
  std::vector<int> table(slots, -1);
  std::vector<int> image(count);
  std::vector<Eigen::Vector3d> kept;
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector3d& p = surface.points[i];
    std::size_t slot = hash_of(p) & (slots - 1);
    while (table[slot] >= 0 && kept[static_cast<std::size_t>(table[slot])] != p)
      slot = (slot + 1) & (slots - 1);
    if (table[slot] < 0) {
      table[slot] = static_cast<int>(kept.size());
      kept.push_back(p);
    }
    image[i] = table[slot];
  }
  const long merged = static_cast<long>(count - kept.size());
  if (merged == 0) return 0;
  surface.points = std::move(kept);
  renumber(surface.triangles, image);
  return merged;
}

long merge_near_points(Surface& surface, const std::vector<int>& candidates, double tolerance) {
  if (!(tolerance > 0.0) || candidates.empty()) return 0;
  Eigen::Vector3d low = surface.points[static_cast<std::size_t>(candidates.front())];
  for (const int v : candidates) low = low.cwiseMin(surface.points[static_cast<std::size_t>(v)]);
  detail::CellHash cells(tolerance, low);
  std::vector<int> image(surface.points.size());
  for (std::size_t i = 0; i < image.size(); ++i) image[i] = static_cast<int>(i);
  long merged = 0;
  for (const int v : candidates) {
    const Eigen::Vector3d& p = surface.points[static_cast<std::size_t>(v)];
    int nearest = -1;
    double nearest_distance = tolerance;
    (void)cells.any_cell_around(p, [&](const std::vector<std::int32_t>& found) {
      for (const std::int32_t u : found) {
        const double distance = (surface.points[static_cast<std::size_t>(u)] - p).norm();
        if (distance <= nearest_distance) {
          nearest = u;
          nearest_distance = distance;
        }
      }
      return false;
    });
    if (nearest < 0) {
      cells.add(p, v);
    } else {
      image[static_cast<std::size_t>(v)] = nearest;
      ++merged;
    }
  }
  if (merged > 0) renumber(surface.triangles, image);
  return merged;
}

long drop_collapsed(Surface& surface) {
  return static_cast<long>(std::erase_if(surface.triangles, [](const std::array<int, 3>& t) {
    return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
  }));
}

long flatten_needles(Surface& surface) {
  const auto longest = [&](const std::array<int, 3>& t) {
    int best = 0;
    double length = -1.0;
    for (int k = 0; k < 3; ++k) {
      const double d =
          (surface.points[static_cast<std::size_t>(t[static_cast<std::size_t>(k)])] -
           surface.points[static_cast<std::size_t>(t[static_cast<std::size_t>((k + 1) % 3)])])
              .norm();
      if (d > length) {
        length = d;
        best = k;
      }
    }
    return std::pair(best, length);
  };
  const auto is_flat = [&](const std::array<int, 3>& t) {
    return !(area_vector(surface, t).norm() > kFlat * surface.diagonal * longest(t).second);
  };
  long count = 0;
  constexpr int kMostPasses = 20;
  for (int pass = 0; pass < kMostPasses; ++pass) {
    std::vector<int> flat;
    for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
      if (is_flat(surface.triangles[i])) flat.push_back(static_cast<int>(i));
    }
    if (pass == 0) count = static_cast<long>(flat.size());
    if (flat.empty()) break;
    // The neighbour behind each directed edge; one of several will do.
    std::unordered_map<std::uint64_t, int> behind;
    const auto key = [](int a, int b) {
      return (static_cast<std::uint64_t>(a) << 32) | static_cast<unsigned>(b);
    };
    for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
      const auto& t = surface.triangles[i];
      for (std::size_t k = 0; k < 3; ++k) behind[key(t[k], t[(k + 1) % 3])] = static_cast<int>(i);
    }
    std::vector<char> touched(surface.triangles.size(), 0);
    std::vector<char> dropped(surface.triangles.size(), 0);
    for (const int i : flat) {
      auto& t = surface.triangles[static_cast<std::size_t>(i)];
      if (touched[static_cast<std::size_t>(i)]) continue;
      const auto k = static_cast<std::size_t>(longest(t).first);
      const int a = t[k];
      const int c = t[(k + 1) % 3];
      const int b = t[(k + 2) % 3];
      const auto neighbour = behind.find(key(c, a));
      if (neighbour == behind.end()) {
        dropped[static_cast<std::size_t>(i)] = 1;
        continue;
      }
      auto& n = surface.triangles[static_cast<std::size_t>(neighbour->second)];
      if (touched[static_cast<std::size_t>(neighbour->second)]) continue;
      touched[static_cast<std::size_t>(i)] = 1;
      touched[static_cast<std::size_t>(neighbour->second)] = 1;
      int d = -1;
      for (const int v : n) {
        if (v != a && v != c) d = v;
      }
      if (d == b) {  // the two lie on each other
        dropped[static_cast<std::size_t>(i)] = 1;
        dropped[static_cast<std::size_t>(neighbour->second)] = 1;
        continue;
      }
      t = {a, d, b};  // the quadrilateral a d c b, cut along d b instead of c a
      n = {b, d, c};
    }
    Triangles kept;
    for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
      if (!dropped[i]) kept.push_back(surface.triangles[i]);
    }
    surface.triangles = std::move(kept);
  }
  if (count > 0) std::erase_if(surface.triangles, is_flat);
  return count;
}

long drop_second_sides(Surface& surface) {
  struct Use {
    int first = -1;
    std::array<int, 2> ways = {0, 0};
  };
  std::map<std::array<int, 3>, Use> uses;
  DisjointSets pieces(surface.triangles.size());
  const std::vector<Side> sides = sorted_sides(surface.triangles);
  for_each_edge(sides, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first + 1; i < last; ++i)
      pieces.join(sides[first].triangle, sides[i].triangle);
  });
  for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
    const auto [key, turned] = canonical(surface.triangles[i]);
    Use& use = uses[key];
    if (use.first < 0) use.first = static_cast<int>(i);
    ++use.ways[turned ? 1 : 0];
  }
  int count = 0;
  const std::vector<int> piece = pieces.numbers(&count);
  std::vector<std::array<long, 2>> tally(static_cast<std::size_t>(count), {0, 0});  // all, doubled
  const auto doubled = [&](const std::array<int, 3>& t) {
    const Use& use = uses.at(canonical(t).first);
    return use.ways[0] > 0 && use.ways[1] > 0;
  };
  for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
    auto& [all, both] = tally[static_cast<std::size_t>(piece[i])];
    ++all;
    both += doubled(surface.triangles[i]);
  }
  Triangles kept;
  for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
    const auto& [all, both] = tally[static_cast<std::size_t>(piece[i])];
    const auto& t = surface.triangles[i];
    if (2 * both > all && doubled(t) && uses.at(canonical(t).first).first != static_cast<int>(i))
      continue;
    kept.push_back(t);
  }
  const long dropped = static_cast<long>(surface.triangles.size() - kept.size());
  surface.triangles = std::move(kept);
  return dropped;
}

long drop_repeated(Surface& surface) {
  std::map<std::array<int, 3>, std::array<int, 2>> uses;
  for (const auto& t : surface.triangles) {
    const auto [key, turned] = canonical(t);
    ++uses[key][turned ? 1 : 0];
  }
  Triangles kept;
  for (const auto& t : surface.triangles) {
    const auto [key, turned] = canonical(t);
    auto& use = uses[key];
    const int own = use[turned ? 1 : 0];
    const int other = use[turned ? 0 : 1];
    if (own <= other) continue;
    kept.push_back(t);
    use = {0, 0};  // the first stays, the rest goes
  }
  const long dropped = static_cast<long>(surface.triangles.size() - kept.size());
  surface.triangles = std::move(kept);
  return dropped;
}

void drop_unused_points(Surface& surface) {
  std::vector<int> image(surface.points.size(), -1);
  for (const auto& t : surface.triangles) {
    for (const int v : t) image[static_cast<std::size_t>(v)] = 0;
  }
  std::size_t next = 0;
  for (std::size_t i = 0; i < image.size(); ++i) {
    if (image[i] < 0) continue;
    image[i] = static_cast<int>(next);
    surface.points[next++] = surface.points[i];
  }
  surface.points.resize(next);
  renumber(surface.triangles, image);
}

double diagonal_of(const Surface& surface) {
  if (surface.triangles.empty()) return 0.0;
  const auto point = [&](int v) { return surface.points[static_cast<std::size_t>(v)]; };
  Eigen::Vector3d low = point(surface.triangles.front()[0]);
  Eigen::Vector3d high = low;
  for (const auto& t : surface.triangles) {
    for (const int v : t) {
      low = low.cwiseMin(point(v));
      high = high.cwiseMax(point(v));
    }
  }
  return (high - low).norm();
}

}  // namespace mortise::parts
