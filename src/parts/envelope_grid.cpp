// SPDX-License-Identifier: GPL-3.0-or-later
// Boxes of nodes, halved.
#include "parts/envelope_grid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "mortise/core/threads.hpp"

namespace mortise::parts {

DistanceGrid envelope_grid(const GridNodes& nodes, std::int32_t count, int threads,
                           const Functions& functions) {
  struct Box {
    Eigen::Array3i from, size;
    std::vector<std::int32_t> which;
  };
  DistanceGrid grid;
  static_cast<GridNodes&>(grid) = nodes;
  grid.values.resize(static_cast<std::size_t>(nodes.count()));

  const auto fill = [&](const Box& box, double value) {
    for (int i = box.from[0]; i < box.from[0] + box.size[0]; ++i)
      for (int j = box.from[1]; j < box.from[1] + box.size[1]; ++j)
        std::fill_n(grid.values.begin() + nodes.index(i, j, box.from[2]), box.size[2],
                    static_cast<float>(value));
  };
  // Leaves those that matter, or fills the box in and leaves none.
  const auto narrow = [&](Box& box, std::vector<double>& values) {
    const Eigen::Vector3d half = 0.5 * nodes.spacing * (box.size - 1).cast<double>().matrix();
    const Eigen::Vector3d middle = nodes.node(box.from[0], box.from[1], box.from[2]) + half;
    functions(box.which, middle, values);
    const double least = *std::min_element(values.begin(), values.end());
    const double rho = half.norm();
    // A hair more than the spacing, for rounding.
    if (std::abs(least) > rho + 1.001 * nodes.spacing) {
      fill(box, least > 0.0 ? least - rho : least + rho);
      box.which.clear();
      return;
    }
    const double limit = least + 2.0 * rho + 1e-3 * nodes.spacing;
    std::size_t kept = 0;
    for (std::size_t n = 0; n < values.size(); ++n)
      if (values[n] <= limit) box.which[kept++] = box.which[n];
    box.which.resize(kept);
  };
  const auto halves = [](const Box& box) {
    std::array<Box, 2> result = {box, box};
    Eigen::Index axis = 0;
    box.size.maxCoeff(&axis);
    result[0].size[axis] = box.size[axis] / 2;
    result[1].size[axis] -= result[0].size[axis];
    result[1].from[axis] += result[0].size[axis];
    return result;
  };
  const auto finish = [&](const auto& self, Box box, std::vector<double>& values) -> void {
    narrow(box, values);
    if (box.which.empty()) return;
    if (box.size.maxCoeff() <= (box.which.size() <= 8 ? 4 : 2)) {
      for (int i = box.from[0]; i < box.from[0] + box.size[0]; ++i)
        for (int j = box.from[1]; j < box.from[1] + box.size[1]; ++j)
          for (int k = box.from[2]; k < box.from[2] + box.size[2]; ++k) {
            functions(box.which, nodes.node(i, j, k), values);
            grid.values[static_cast<std::size_t>(nodes.index(i, j, k))] =
                static_cast<float>(*std::min_element(values.begin(), values.end()));
          }
      return;
    }
    for (Box& half : halves(box)) self(self, std::move(half), values);
  };

  // Down to this edge all boxes of a level at once, then each by itself.
  constexpr int kEdge = 24;
  std::vector<Box> boxes(1);
  boxes[0].from.setZero();
  boxes[0].size = nodes.size;
  boxes[0].which.resize(static_cast<std::size_t>(count));
  std::iota(boxes[0].which.begin(), boxes[0].which.end(), 0);
  while (boxes.front().size.maxCoeff() > kEdge) {  // halves differ by one node at most
    parallel_for(boxes.size(), threads, [&](std::size_t b, int) {
      std::vector<double> values;
      narrow(boxes[b], values);
    });
    std::vector<Box> next;
    for (const Box& box : boxes)
      if (!box.which.empty())
        for (Box& half : halves(box)) next.push_back(std::move(half));
    boxes = std::move(next);
    if (boxes.empty()) return grid;
  }
  parallel_for(boxes.size(), threads, [&](std::size_t b, int) {
    std::vector<double> values;
    finish(finish, std::move(boxes[b]), values);
  });
  return grid;
}

}  // namespace mortise::parts
