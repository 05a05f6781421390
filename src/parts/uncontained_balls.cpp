// SPDX-License-Identifier: GPL-3.0-or-later
// Dropping balls that lie in others, by cells of the size of the balls.
#include "mortise/parts/uncontained_balls.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <string>
#include <unordered_map>

#include "mortise/core/errors.hpp"

namespace mortise {
namespace {

// Kept balls of one octave of reach, in cells as large as the longest reach: a point in the reach
// of a ball lies in the ball's cell or one beside it.
class Octave {
 public:
  explicit Octave(double cell) : cell_(cell) {}

  void insert(const Eigen::Vector3d& center, Eigen::Index ball) {
    cells_[key(cell_of(center))].push_back(ball);
  }

  // Whether found(ball) holds for a ball in the cells about the point.
  template <typename Found>
  [[nodiscard]] bool any_near(const Eigen::Vector3d& point, const Found& found) const {
    const std::array<std::int64_t, 3> home = cell_of(point);
    for (std::int64_t x = home[0] - 1; x <= home[0] + 1; ++x)
      for (std::int64_t y = home[1] - 1; y <= home[1] + 1; ++y)
        for (std::int64_t z = home[2] - 1; z <= home[2] + 1; ++z) {
          const auto cell = cells_.find(key({x, y, z}));
          if (cell != cells_.end() && std::any_of(cell->second.begin(), cell->second.end(), found))
            return true;
        }
    return false;
  }

 private:
  [[nodiscard]] std::array<std::int64_t, 3> cell_of(const Eigen::Vector3d& point) const {
    std::array<std::int64_t, 3> cell{};
    for (int d = 0; d < 3; ++d)  // far out all cells are one: slow there, never wrong
      cell[d] = static_cast<std::int64_t>(std::clamp(std::floor(point[d] / cell_), -1e15, 1e15));
    return cell;
  }
  static std::uint64_t key(const std::array<std::int64_t, 3>& cell) {
    std::uint64_t hash = 0;  // equal hashes only add candidates
    for (const std::int64_t c : cell)
      hash = (hash ^ static_cast<std::uint64_t>(c)) * 0x9E3779B97F4A7C15U;
    return hash;
  }

  double cell_;
  std::unordered_map<std::uint64_t, std::vector<Eigen::Index>> cells_;
};

}  // namespace

std::vector<Eigen::Index> uncontained_balls(const Eigen::Matrix4Xd& balls, double growth) {
  if (!(growth >= 0.0) || !std::isfinite(growth))
    throw InputError("uncontained_balls: growth must be >= 0, got " + std::to_string(growth));
  if (balls.cols() == 0) return {};
  if (!balls.allFinite() || (balls.row(3).array() < 0.0).any())
    throw InputError("uncontained_balls: balls must be finite with radii >= 0");
  std::vector<Eigen::Index> order(static_cast<std::size_t>(balls.cols()));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](Eigen::Index a, Eigen::Index b) { return balls(3, a) > balls(3, b); });
  std::map<int, Octave> octaves;  // by the binary exponent of the reach
  std::vector<Eigen::Index> kept;
  for (const Eigen::Index i : order) {
    const Eigen::Vector3d center = balls.col(i).head<3>();
    const double radius = balls(3, i);
    const auto holds = [&](Eigen::Index k) {
      const double reach = balls(3, k) + growth - radius;
      return (balls.col(k).head<3>() - center).squaredNorm() <= reach * reach;
    };
    const bool contained = std::any_of(octaves.begin(), octaves.end(), [&](const auto& octave) {
      return octave.second.any_near(center, holds);
    });
    if (contained) continue;
    kept.push_back(i);
    // Reaches below the smallest normal number share one octave.
    const int exponent =
        std::ilogb(std::max(radius + growth, std::numeric_limits<double>::min())) + 1;
    octaves.try_emplace(exponent, std::ldexp(1.0, exponent)).first->second.insert(center, i);
  }
  return kept;
}

}  // namespace mortise
