// SPDX-License-Identifier: GPL-3.0-or-later
// Trees of balls: grouping by halves along the longest side, enclosing balls, nearest ball.
#include "mortise/parts/sphere_tree.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

#include "mortise/core/errors.hpp"
#include "mortise/core/threads.hpp"
#include "parts/smallest_enclosing_ball.hpp"

namespace mortise {
namespace {

// The nodes of one level; `order` puts a group's members next to each other.
struct Level {
  Eigen::Matrix4Xd balls;
  std::vector<int> first, count;  // children in the level below; for leaves the ball given and 0
};

// Splits order[first, last) into groups of `arity` near balls (the last of all may be smaller) and
// appends their ends.
void group(const Eigen::Matrix4Xd& balls, std::vector<int>& order, int first, int last, int arity,
           std::vector<int>& ends) {
  const int count = last - first;
  if (count <= arity) {
    ends.push_back(last);
    return;
  }
  Eigen::AlignedBox3d box;
  for (int i = first; i < last; ++i) box.extend(Eigen::Vector3d(balls.col(order[i]).head<3>()));
  Eigen::Index axis = 0;
  box.sizes().maxCoeff(&axis);
  const int groups = (count + arity - 1) / arity;
  const int middle = first + groups / 2 * arity;
  std::nth_element(
      order.begin() + first, order.begin() + middle, order.begin() + last, [&](int a, int b) {
        return balls(axis, a) != balls(axis, b) ? balls(axis, a) < balls(axis, b) : a < b;
      });
  group(balls, order, first, middle, arity, ends);
  group(balls, order, middle, last, arity, ends);
}

// Puts the level's nodes in groups and returns the level above.
Level parents_of(Level& level, int arity) {
  const auto count = static_cast<int>(level.balls.cols());
  std::vector<int> order(count), ends;
  std::iota(order.begin(), order.end(), 0);
  group(level.balls, order, 0, count, arity, ends);
  Level sorted, above;
  sorted.balls.resize(4, count);
  for (int i = 0; i < count; ++i) {
    sorted.balls.col(i) = level.balls.col(order[i]);
    sorted.first.push_back(level.first[order[i]]);
    sorted.count.push_back(level.count[order[i]]);
  }
  level = std::move(sorted);
  above.balls.resize(4, static_cast<Eigen::Index>(ends.size()));
  int first = 0;
  for (std::size_t g = 0; g < ends.size(); ++g) {
    above.balls.col(static_cast<Eigen::Index>(g)) =
        parts::smallest_enclosing_ball(level.balls.middleCols(first, ends[g] - first));
    above.first.push_back(first);
    above.count.push_back(ends[g] - first);
    first = ends[g];
  }
  return above;
}

double distance(const SphereTree& tree, const Eigen::Vector3d& p,
                std::vector<std::pair<double, int>>& stack) {
  const auto bound = [&](int node) {
    return (tree.balls.col(node).head<3>() - p).norm() - tree.balls(3, node);
  };
  double best = std::numeric_limits<double>::infinity();
  stack.assign(1, {bound(0), 0});
  while (!stack.empty()) {
    const auto [low, node] = stack.back();
    stack.pop_back();
    if (low >= best) continue;
    const int count = tree.children[node];
    if (count == 0) {
      best = low;
      continue;
    }
    const auto base = static_cast<std::ptrdiff_t>(stack.size());
    for (int c = tree.first_child[node]; c < tree.first_child[node] + count; ++c)
      if (const double d = bound(c); d < best) stack.emplace_back(d, c);
    std::sort(stack.begin() + base, stack.end(), std::greater<>());  // nearest on top
  }
  return best;
}

}  // namespace

SphereTree sphere_tree(const Eigen::Matrix4Xd& balls, const SphereTreeOptions& options) {
  if (options.arity < 2 || options.arity > 64)
    throw InputError("sphere_tree: arity must be 2 to 64, got " + std::to_string(options.arity));
  if (balls.cols() == 0) throw InputError("sphere_tree: at least one ball expected, got none");
  if (!balls.allFinite() || (balls.row(3).array() < 0.0).any())
    throw InputError("sphere_tree: balls must be finite with radii >= 0");
  std::vector<Level> levels(1);
  levels[0].balls = balls;
  levels[0].first.resize(balls.cols());
  std::iota(levels[0].first.begin(), levels[0].first.end(), 0);
  levels[0].count.assign(balls.cols(), 0);
  while (levels.back().balls.cols() > 1) levels.push_back(parents_of(levels.back(), options.arity));

  SphereTree tree;
  Eigen::Index size = 0;
  for (const Level& level : levels) size += level.balls.cols();
  tree.balls.resize(4, size);
  tree.first_child.resize(size);
  tree.children.resize(size);
  tree.leaf.setConstant(size, -1);
  // Level by level, the children in the order of their parents.
  std::vector<int> order = {0};
  Eigen::Index at = 0;
  std::reverse(levels.begin(), levels.end());
  for (const Level& level : levels) {
    auto next = static_cast<int>(at + level.balls.cols());
    std::vector<int> below;
    for (const int node : order) {
      const int count = level.count[node];
      tree.balls.col(at) = level.balls.col(node);
      tree.children[at] = count;
      tree.first_child[at] = count == 0 ? -1 : next;
      if (count == 0) tree.leaf[at] = level.first[node];
      for (int c = 0; c < count; ++c) below.push_back(level.first[node] + c);
      next += count;
      ++at;
    }
    order = std::move(below);
  }
  return tree;
}

void check_sphere_tree(const SphereTree& tree, Eigen::Index leaves, const char* who) {
  const Eigen::Index size = tree.size();
  const auto require = [&](bool good, const std::string& message) {
    if (!good) throw InputError(std::string(who) + ": " + message);
  };
  require(size >= 1 && tree.first_child.size() == size && tree.children.size() == size &&
              tree.leaf.size() == size,
          "as many balls, first children, child counts and leaves expected, at least one");
  require(tree.balls.allFinite() && (tree.balls.row(3).array() >= 0.0).all(),
          "finite balls with radii >= 0 expected");
  std::vector<char> seen(static_cast<std::size_t>(leaves), 0);
  Eigen::Index next = 1;  // children follow each other level by level, so in the order of parents
  for (Eigen::Index i = 0; i < size; ++i) {
    const std::string where = "ball " + std::to_string(i) + ": ";
    const int count = tree.children[i];
    if (count == 0) {
      const int leaf = tree.leaf[i];
      require(leaf >= 0 && leaf < leaves && seen[leaf] == 0,
              where + "a leaf not met before expected, found " + std::to_string(leaf));
      seen[leaf] = 1;
      continue;
    }
    require(count > 0 && tree.first_child[i] == next && count <= size - next,
            where + "children from " + std::to_string(next) + " on expected, found " +
                std::to_string(count) + " from " + std::to_string(tree.first_child[i]));
    next += count;
    for (Eigen::Index c = next - count; c < next; ++c)
      require((tree.balls.col(c) - tree.balls.col(i)).head<3>().norm() + tree.balls(3, c) <=
                  tree.balls(3, i) * (1.0 + 1e-12),
              "ball " + std::to_string(c) + " sticks out of its parent");
  }
  require(next == size, "one root expected");
  require(std::count(seen.begin(), seen.end(), 1) == leaves,
          std::to_string(leaves) + " leaves expected");
}

Eigen::VectorXd distance_to_union(const SphereTree& tree, const Eigen::Matrix3Xd& points,
                                  int threads) {
  if (tree.size() == 0) throw InputError("distance_to_union: a tree with a ball expected");
  if (!points.allFinite()) throw InputError("distance_to_union: finite points expected");
  Eigen::VectorXd result(points.cols());
  constexpr Eigen::Index kChunk = 512;
  const Eigen::Index chunks = (points.cols() + kChunk - 1) / kChunk;
  parallel_for(static_cast<std::size_t>(chunks), threads, [&](std::size_t chunk, int) {
    std::vector<std::pair<double, int>> stack;
    const Eigen::Index first = static_cast<Eigen::Index>(chunk) * kChunk;
    for (Eigen::Index i = first; i < std::min(points.cols(), first + kChunk); ++i)
      result[i] = distance(tree, points.col(i), stack);
  });
  return result;
}

}  // namespace mortise
