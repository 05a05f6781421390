// SPDX-License-Identifier: GPL-3.0-or-later
// Drops balls that lie inside others, by the depth of every place inside the union.
//
// depth(x) = max_l (r_l - |x - c_l|) falls by at most |x - y| from x to y, and a ball of radius
// s about x lies in some ball l if s <= depth(x). Each cell's centre takes the depth that its own
// balls give it and what its neighbours' depth leaves after the step between them, in two sweeps:
// a path of such steps is no shorter than the straight line, so the result is never too deep.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "mortise/collision/minkowski.hpp"
#include "mortise/core/errors.hpp"

namespace mortise {
namespace {

constexpr float kNone = -std::numeric_limits<float>::infinity();

class DepthGrid {
 public:
  DepthGrid(const Balls& balls, int cells) {
    const Eigen::Array3f low = balls.topRows<3>().rowwise().minCoeff();
    const Eigen::Array3f high = balls.topRows<3>().rowwise().maxCoeff();
    origin_ = low;
    step_ = std::max((high - low).maxCoeff() / static_cast<float>(cells),
                     std::numeric_limits<float>::min());
    for (int d = 0; d < 3; ++d)
      size_[static_cast<std::size_t>(d)] =
          std::min(cells - 1, static_cast<int>((high[d] - low[d]) / step_)) + 1;
    depth_.assign(static_cast<std::size_t>(size_[0]) * size_[1] * size_[2], kNone);
  }

  [[nodiscard]] std::size_t cell_of(const Eigen::Array3f& x) const {
    std::size_t cell = 0;
    for (int d = 0; d < 3; ++d) {
      const int n = size_[static_cast<std::size_t>(d)];
      const int i = std::clamp(static_cast<int>((x[d] - origin_[d]) / step_), 0, n - 1);
      cell = cell * static_cast<std::size_t>(n) + static_cast<std::size_t>(i);
    }
    return cell;
  }

  [[nodiscard]] Eigen::Array3f centre_of(std::size_t cell) const {
    Eigen::Array3f x;
    for (int d = 2; d >= 0; --d) {
      const auto n = static_cast<std::size_t>(size_[static_cast<std::size_t>(d)]);
      x[d] = origin_[d] + step_ * (static_cast<float>(cell % n) + 0.5F);
      cell /= n;
    }
    return x;
  }

  [[nodiscard]] std::size_t size() const { return depth_.size(); }
  [[nodiscard]] float depth(std::size_t cell) const { return depth_[cell]; }
  void raise(std::size_t cell, float depth) { depth_[cell] = std::max(depth_[cell], depth); }

  // Two sweeps over the 26 neighbours, 13 at a time.
  void propagate() {
    struct Neighbour {
      int x, y, z;
      float length;
    };
    std::vector<Neighbour> before;
    for (int x = -1; x <= 1; ++x)
      for (int y = -1; y <= 1; ++y)
        for (int z = -1; z <= 1; ++z)
          if (x * 9 + y * 3 + z < 0)
            before.push_back(
                {x, y, z, 1.0001F * step_ * std::sqrt(static_cast<float>(x * x + y * y + z * z))});
    const auto [nx, ny, nz] = size_;
    for (const int sign : {1, -1})
      for (int i = 0; i < nx; ++i)
        for (int j = 0; j < ny; ++j)
          for (int k = 0; k < nz; ++k) {
            const int x = sign > 0 ? i : nx - 1 - i;
            const int y = sign > 0 ? j : ny - 1 - j;
            const int z = sign > 0 ? k : nz - 1 - k;
            float& here = depth_[index(x, y, z)];
            for (const Neighbour& n : before) {
              const int u = x + sign * n.x;
              const int v = y + sign * n.y;
              const int w = z + sign * n.z;
              if (u < 0 || v < 0 || w < 0 || u >= nx || v >= ny || w >= nz) continue;
              here = std::max(here, depth_[index(u, v, w)] - n.length);
            }
          }
  }

 private:
  [[nodiscard]] std::size_t index(int x, int y, int z) const {
    return (static_cast<std::size_t>(x) * size_[1] + static_cast<std::size_t>(y)) * size_[2] +
           static_cast<std::size_t>(z);
  }

  Eigen::Array3f origin_;
  float step_ = 1.0F;
  std::array<int, 3> size_ = {};
  std::vector<float> depth_;
};

}  // namespace

Balls without_contained(const Balls& balls, int cells) {
  if (cells < 2 || cells > 512)
    throw InputError("without_contained: cells must be in 2 to 512, got " + std::to_string(cells));
  if (!balls.allFinite()) throw InputError("without_contained: expected finite centres and radii");
  if (balls.cols() == 0) return balls;
  if (balls.row(3).minCoeff() < 0.0F)
    throw InputError("without_contained: radii must be >= 0, got " +
                     std::to_string(balls.row(3).minCoeff()));
  DepthGrid grid(balls, cells);
  const Eigen::Index n = balls.cols();
  std::vector<std::uint32_t> cell(static_cast<std::size_t>(n));
  std::vector<float> off(static_cast<std::size_t>(n));  // of the centre from its cell's
  std::vector<Eigen::Index> deepest(grid.size(), -1);   // of each cell's own balls, the first such
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const std::size_t c = grid.cell_of(balls.col(i).head<3>());
    cell[at] = static_cast<std::uint32_t>(c);
    off[at] = (balls.col(i).head<3>().array() - grid.centre_of(c)).matrix().norm();
    const float depth = balls(3, i) - off[at];
    Eigen::Index& best = deepest[c];
    if (best < 0 || depth > balls(3, best) - off[static_cast<std::size_t>(best)]) best = i;
    grid.raise(c, depth);
  }
  grid.propagate();

  // Strictly inside a strictly larger ball, or inside the deepest of its own cell: containment is
  // transitive and the larger ball is never dropped for the smaller, so one that stays holds it.
  std::vector<char> keep(static_cast<std::size_t>(n), 1);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const float radius = balls(3, i);
    const Eigen::Index best = deepest[cell[at]];
    const float gap = (balls.col(i).head<3>() - balls.col(best).head<3>()).norm();
    const bool in_own =
        best != i && gap + radius <= balls(3, best) && (radius < balls(3, best) || best < i);
    const bool in_deeper = grid.depth(cell[at]) - off[at] > radius * 1.000001F;
    keep[at] = in_own || in_deeper ? 0 : 1;
  }
  const auto count = static_cast<Eigen::Index>(std::count(keep.begin(), keep.end(), char{1}));
  Balls result(4, count);
  Eigen::Index at = 0;
  for (Eigen::Index i = 0; i < n; ++i)
    if (keep[static_cast<std::size_t>(i)] != 0) result.col(at++) = balls.col(i);
  return result;
}

}  // namespace mortise
