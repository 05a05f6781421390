// SPDX-License-Identifier: GPL-3.0-or-later
// Dropping balls that lie in others, by cells of the size of the balls.
#include "mortise/parts/uncontained_balls.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <string>

#include "core/cell_hash.hpp"
#include "mortise/core/errors.hpp"

namespace mortise {
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
  // Kept balls by the binary exponent of their reach, in cells as large as the longest reach: a
  // point in the reach of a ball lies in the ball's cell or one beside it.
  std::map<int, detail::CellHash> octaves;
  std::vector<Eigen::Index> kept;
  for (const Eigen::Index i : order) {
    const Eigen::Vector3d center = balls.col(i).head<3>();
    const double radius = balls(3, i);
    const auto holds = [&](std::int32_t k) {
      const double reach = balls(3, k) + growth - radius;
      return (balls.col(k).head<3>() - center).squaredNorm() <= reach * reach;
    };
    const bool contained = std::any_of(octaves.begin(), octaves.end(), [&](const auto& octave) {
      return octave.second.any_cell_around(center, [&](const std::vector<std::int32_t>& kept_near) {
        return std::any_of(kept_near.begin(), kept_near.end(), holds);
      });
    });
    if (contained) continue;
    kept.push_back(i);
    // Reaches below the smallest normal number share one octave.
    const int exponent =
        std::ilogb(std::max(radius + growth, std::numeric_limits<double>::min())) + 1;
    octaves.try_emplace(exponent, std::ldexp(1.0, exponent))
        .first->second.add(center, static_cast<std::int32_t>(i));
  }
  return kept;
}

}  // namespace mortise
