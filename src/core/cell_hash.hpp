// SPDX-License-Identifier: GPL-3.0-or-later
// Cells that fill as points come: what is near those that came before.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace mortise::detail {

// Items at places of an endless grid of cells. All items within an edge of a place are in the cells
// around it; others may be, too.
class CellHash {
 public:
  // edge > 0; cells begin at the origin
  explicit CellHash(double edge, const Eigen::Vector3d& origin = Eigen::Vector3d::Zero())
      : edge_(edge), origin_(origin) {}

  void add(const Eigen::Vector3d& place, std::int32_t item) {
    const Cell home = cell_of(place);
    items_[key(home[0], home[1], home[2])].push_back(item);
  }

  // Calls visit(items), in the order they were added, for each cell around the place, x fastest,
  // until it returns true. Returns whether it did.
  template <class Visit>
  bool any_cell_around(const Eigen::Vector3d& place, const Visit& visit) const {
    const Cell home = cell_of(place);
    for (std::int64_t z = home[2] - 1; z <= home[2] + 1; ++z)
      for (std::int64_t y = home[1] - 1; y <= home[1] + 1; ++y)
        for (std::int64_t x = home[0] - 1; x <= home[0] + 1; ++x) {
          const auto found = items_.find(key(x, y, z));
          if (found != items_.end() && visit(found->second)) return true;
        }
    return false;
  }

 private:
  using Cell = std::array<std::int64_t, 3>;
  [[nodiscard]] Cell cell_of(const Eigen::Vector3d& place) const {
    Cell cell{};
    for (int d = 0; d < 3; ++d)  // far out all cells are one: slow there, never wrong
      cell[static_cast<std::size_t>(d)] = static_cast<std::int64_t>(
          std::clamp(std::floor((place[d] - origin_[d]) / edge_), -1e15, 1e15));
    return cell;
  }
  // 21 bits an axis: cells beside each other along x have keys beside each other, and so places in
  // the table. Equal keys of far cells only add candidates.
  static std::uint64_t key(std::int64_t x, std::int64_t y, std::int64_t z) {
    constexpr std::uint64_t kBits = 0x1fffff;
    return (static_cast<std::uint64_t>(z) & kBits) << 42 |
           (static_cast<std::uint64_t>(y) & kBits) << 21 | (static_cast<std::uint64_t>(x) & kBits);
  }

  double edge_;
  Eigen::Vector3d origin_;
  std::unordered_map<std::uint64_t, std::vector<std::int32_t>> items_;
};

}  // namespace mortise::detail
