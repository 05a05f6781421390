// SPDX-License-Identifier: GPL-3.0-or-later
// Orientation by flooding over edges, outward by signed volume and containment.
#include "parts/orient.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace mortise::parts {
namespace {

void turn_over(std::array<int, 3>& t) { std::swap(t[1], t[2]); }

struct Shell {
  std::vector<int> triangles;
  Eigen::AlignedBox3d box;
  double volume = 0.0;
  bool closed = true;
};

/// Winding number of the shell at p by the direct sum of solid angles.
double winding_number(const Surface& surface, const Shell& shell, const Eigen::Vector3d& p) {
  double sum = 0.0;
  for (const int i : shell.triangles) {
    const auto& t = surface.triangles[static_cast<std::size_t>(i)];
    const Eigen::Vector3d a = surface.points[static_cast<std::size_t>(t[0])] - p;
    const Eigen::Vector3d b = surface.points[static_cast<std::size_t>(t[1])] - p;
    const Eigen::Vector3d c = surface.points[static_cast<std::size_t>(t[2])] - p;
    const double la = a.norm();
    const double lb = b.norm();
    const double lc = c.norm();
    sum +=
        std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return sum / (2.0 * std::numbers::pi);
}

bool holds(const Surface& surface, const Shell& outer, const Shell& inner) {
  if (!outer.closed || !outer.box.contains(inner.box)) return false;
  const auto& t = surface.triangles[static_cast<std::size_t>(inner.triangles.front())];
  const Eigen::Vector3d p = (surface.points[static_cast<std::size_t>(t[0])] +
                             surface.points[static_cast<std::size_t>(t[1])] +
                             surface.points[static_cast<std::size_t>(t[2])]) /
                            3.0;
  return std::abs(winding_number(surface, outer, p)) > 0.5;
}

/// Patches joined by edges of two triangles, and by other edges where one patch alone is open.
std::vector<Shell> shells_of(const Surface& surface, const std::vector<Side>& sides) {
  DisjointSets sets(surface.triangles.size());
  for_each_edge(sides, [&](std::size_t first, std::size_t last) {
    if (last - first == 2) sets.join(sides[first].triangle, sides[first + 1].triangle);
  });
  std::vector<std::pair<int, int>> of_patch;  // patch, surplus
  for_each_edge(sides, [&](std::size_t first, std::size_t last) {
    if (last - first <= 2) return;
    of_patch.clear();
    for (std::size_t i = first; i < last; ++i)
      of_patch.emplace_back(sets.find(sides[i].triangle),
                            runs_forward(surface.triangles, sides[i]) ? 1 : -1);
    std::sort(of_patch.begin(), of_patch.end());
    int unbalanced = -1;
    for (std::size_t i = 0; i < of_patch.size();) {
      int surplus = 0;
      const int patch = of_patch[i].first;
      for (; i < of_patch.size() && of_patch[i].first == patch; ++i) surplus += of_patch[i].second;
      if (surplus == 0) continue;
      if (unbalanced >= 0) sets.join(unbalanced, patch);
      unbalanced = patch;
    }
  });
  int count = 0;
  const std::vector<int> number = sets.numbers(&count);
  std::vector<Shell> shells(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
    Shell& shell = shells[static_cast<std::size_t>(number[i])];
    shell.triangles.push_back(static_cast<int>(i));
    for (const int v : surface.triangles[i])
      shell.box.extend(surface.points[static_cast<std::size_t>(v)]);
  }
  for (const OpenEdge& edge : open_edges(surface.triangles, sides)) {
    const auto low = static_cast<std::uint64_t>(std::min(edge.from, edge.to));
    const std::uint64_t key = (low << 32) | static_cast<unsigned>(std::max(edge.from, edge.to));
    auto side = std::lower_bound(sides.begin(), sides.end(), key,
                                 [](const Side& s, std::uint64_t k) { return s.edge < k; });
    for (; side != sides.end() && side->edge == key; ++side)
      shells[static_cast<std::size_t>(number[static_cast<std::size_t>(side->triangle)])].closed =
          false;
  }
  for (Shell& shell : shells) {
    const Eigen::Vector3d centre = shell.box.center();
    for (const int i : shell.triangles) {
      const auto& t = surface.triangles[static_cast<std::size_t>(i)];
      shell.volume +=
          area_vector(surface, t).dot(surface.points[static_cast<std::size_t>(t[0])] - centre) /
          6.0;
    }
  }
  return shells;
}

}  // namespace

Turned agree_with_neighbours(Surface& surface, const std::vector<Side>& sides) {
  auto& triangles = surface.triangles;
  std::vector<std::array<int, 3>> neighbour(triangles.size(), {-1, -1, -1});
  std::vector<std::array<char, 3>> differs(triangles.size(), {0, 0, 0});
  for_each_edge(sides, [&](std::size_t first, std::size_t last) {
    if (last - first != 2) return;
    const Side& a = sides[first];
    const Side& b = sides[first + 1];
    const bool differ = runs_forward(triangles, a) == runs_forward(triangles, b);
    const auto note = [&](const Side& s, int other) {
      neighbour[static_cast<std::size_t>(s.triangle)][static_cast<std::size_t>(s.corner)] = other;
      differs[static_cast<std::size_t>(s.triangle)][static_cast<std::size_t>(s.corner)] = differ;
    };
    note(a, b.triangle);
    note(b, a.triangle);
  });
  Turned result;
  std::vector<signed char> turn(triangles.size(), -1);
  std::vector<int> patch;
  for (std::size_t seed = 0; seed < triangles.size(); ++seed) {
    if (turn[seed] >= 0) continue;
    patch.assign(1, static_cast<int>(seed));
    turn[seed] = 0;
    long turned = 0;
    for (std::size_t next = 0; next < patch.size(); ++next) {
      const auto i = static_cast<std::size_t>(patch[next]);
      for (std::size_t k = 0; k < 3; ++k) {
        if (neighbour[i][k] < 0) continue;
        const auto j = static_cast<std::size_t>(neighbour[i][k]);
        const auto wanted = static_cast<signed char>(turn[i] ^ differs[i][k]);
        if (turn[j] < 0) {
          turn[j] = wanted;
          turned += wanted;
          patch.push_back(static_cast<int>(j));
        } else if (turn[j] != wanted) {
          if (result.first_corner < 0) result.first_corner = triangles[i][k];
          ++result.one_sided;
        }
      }
    }
    const bool most = 2 * turned > static_cast<long>(patch.size());
    result.triangles += most ? static_cast<long>(patch.size()) - turned : turned;
    for (const int i : patch) {
      if ((turn[static_cast<std::size_t>(i)] != 0) != most)
        turn_over(triangles[static_cast<std::size_t>(i)]);
    }
  }
  result.one_sided /= 2;  // each edge was met from both sides
  return result;
}

Outward turn_outward(Surface& surface, const std::vector<Side>& sides) {
  std::vector<Shell> shells = shells_of(surface, sides);
  Outward result;
  const double no_volume = 1e-12 * std::pow(surface.diagonal, 3);
  std::vector<char> dropped(surface.triangles.size(), 0);
  std::vector<std::size_t> inward;
  for (std::size_t i = 0; i < shells.size(); ++i) {
    if (!shells[i].closed) continue;
    ++result.shells;
    if (std::abs(shells[i].volume) <= no_volume) {
      ++result.flat;
      for (const int t : shells[i].triangles) dropped[static_cast<std::size_t>(t)] = 1;
      shells[i].closed = false;  // neither holds nor is turned
    } else if (shells[i].volume < 0.0) {
      inward.push_back(i);
    }
  }
  const auto turn = [&](Shell& shell) {
    for (const int t : shell.triangles) turn_over(surface.triangles[static_cast<std::size_t>(t)]);
    shell.volume = -shell.volume;
    ++result.turned;
  };
  // So many shells are no part but a cloud of pieces: no cavities are looked for.
  constexpr double kMostTests = 2e7;
  const bool few =
      static_cast<double>(inward.size()) * static_cast<double>(shells.size()) < kMostTests;
  std::vector<std::size_t> outermost;
  for (const std::size_t i : inward) {
    const bool held = few && std::any_of(shells.begin(), shells.end(), [&](const Shell& outer) {
                        return &outer != &shells[i] && holds(surface, outer, shells[i]);
                      });
    if (!held) outermost.push_back(i);
  }
  std::vector<char> to_turn(shells.size(), 0);
  for (const std::size_t i : outermost) {
    to_turn[i] = 1;
    for (std::size_t j = 0; few && j < shells.size(); ++j) {
      if (j != i && shells[j].closed && holds(surface, shells[i], shells[j])) to_turn[j] = 1;
    }
  }
  for (std::size_t i = 0; i < shells.size(); ++i) {
    if (to_turn[i]) turn(shells[i]);
    if (shells[i].closed) result.volume += shells[i].volume;
  }
  if (result.flat > 0) {
    Triangles kept;
    for (std::size_t i = 0; i < dropped.size(); ++i) {
      if (!dropped[i]) kept.push_back(surface.triangles[i]);
    }
    surface.triangles = std::move(kept);
    result.shells -= result.flat;
  }
  return result;
}

}  // namespace mortise::parts
