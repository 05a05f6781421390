// SPDX-License-Identifier: GPL-3.0-or-later
// Built top down by halving the longest extent; a parent is the smallest ball around its two
// children.
#include "collision/ball_tree.hpp"

#include <algorithm>
#include <array>
#include <numeric>

namespace mortise {

BallTree::BallTree(const Eigen::Matrix4Xd& balls, double margin) {
  std::vector<int> order(static_cast<std::size_t>(balls.cols()));
  std::iota(order.begin(), order.end(), 0);
  nodes_.reserve(2 * order.size());
  extent_ = balls.topRows<3>().cwiseAbs().maxCoeff() + balls.row(3).maxCoeff();
  build(balls, margin, order, 0, static_cast<int>(order.size()));
}

int BallTree::build(const Eigen::Matrix4Xd& balls, double margin, std::vector<int>& order,
                    int first, int last) {
  Node node;
  if (last - first == 1) {
    node.centre = balls.col(order[first]).head<3>();
    node.radius = balls(3, order[first]);
    node.inner = node.radius - margin;
  } else {
    Eigen::Vector3d low = balls.col(order[first]).head<3>(), high = low;
    for (int i = first; i < last; ++i) {
      low = low.cwiseMin(balls.col(order[i]).head<3>());
      high = high.cwiseMax(balls.col(order[i]).head<3>());
    }
    int axis = 0;
    (high - low).maxCoeff(&axis);
    const int middle = (first + last) / 2;
    std::nth_element(order.begin() + first, order.begin() + middle, order.begin() + last,
                     [&](int a, int b) { return balls(axis, a) < balls(axis, b); });
    node.left = build(balls, margin, order, first, middle);
    node.right = build(balls, margin, order, middle, last);
    const Node &a = nodes_[node.left], &b = nodes_[node.right];
    const Eigen::Vector3d step = b.centre - a.centre;
    const double d = step.norm();
    if (d + b.radius <= a.radius) {
      node.centre = a.centre, node.radius = a.radius;
    } else if (d + a.radius <= b.radius) {
      node.centre = b.centre, node.radius = b.radius;
    } else {
      node.radius = 0.5 * (d + a.radius + b.radius);
      node.centre = a.centre + step * ((node.radius - a.radius) / d);
    }
  }
  nodes_.push_back(node);
  return static_cast<int>(nodes_.size()) - 1;
}

BallTree::Verdict BallTree::compare(const BallTree& fixed, const BallTree& moving,
                                    const RigidMotion& moving_in_fixed, std::int64_t steps) {
  const Eigen::Matrix3d rotation = moving_in_fixed.rotation.toRotationMatrix();
  const Eigen::Vector3d& shift = moving_in_fixed.translation;
  struct Pair {
    int fixed, moving;
  };
  // Each step puts two pairs for one: the stack is no deeper than the two trees together.
  std::array<Pair, 256> stack;
  int top = 0;
  stack[top++] = {static_cast<int>(fixed.nodes_.size()) - 1,
                  static_cast<int>(moving.nodes_.size()) - 1};
  bool between = false;
  // Rounding must not part balls that touch: radii count a hair more, inner ones a hair less. The
  // errors are of the coordinates, a few per level of the trees.
  const double hair = 5e-14 * (fixed.extent_ + moving.extent_ + moving_in_fixed.translation.norm());
  while (top > 0) {
    if (steps-- <= 0) return between ? Verdict::kBetween : Verdict::kStopped;
    const Pair pair = stack[--top];
    const Node &a = fixed.nodes_[pair.fixed], &b = moving.nodes_[pair.moving];
    const double d_sq = (a.centre - (rotation * b.centre + shift)).squaredNorm();
    const double reach = a.radius + b.radius + hair;
    if (d_sq >= reach * reach) continue;
    if (a.left < 0 && b.left < 0) {
      const double inner = a.inner + b.inner - hair;
      if (a.inner > 0.0 && b.inner > 0.0 && inner > 0.0 && d_sq < inner * inner)
        return Verdict::kMeet;
      between = true;
    } else if (b.left < 0 || (a.left >= 0 && a.radius > b.radius)) {
      stack[top++] = {a.left, pair.moving};
      stack[top++] = {a.right, pair.moving};
    } else {
      stack[top++] = {pair.fixed, b.left};
      stack[top++] = {pair.fixed, b.right};
    }
  }
  return between ? Verdict::kBetween : Verdict::kApart;
}

}  // namespace mortise
