// SPDX-License-Identifier: GPL-3.0-or-later
// The boundary of a union of balls: overlaps, circles, and what of them no third ball holds.
#include "parts/ball_boundary.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "mortise/parts/uncontained_balls.hpp"

namespace mortise::parts {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr double kTolerance = 1e-10;  // of a radius: less deep in a ball counts as on its sphere

std::vector<int> overlapping(const SphereTree& tree, const Eigen::Matrix4Xd& balls, int ball) {
  std::vector<int> found, stack = {0};
  while (!stack.empty()) {
    const int node = stack.back();
    stack.pop_back();
    if ((tree.balls.col(node) - balls.col(ball)).head<3>().norm() >=
        tree.balls(3, node) + balls(3, ball))
      continue;
    if (tree.children[node] == 0 && tree.leaf[node] != ball) found.push_back(tree.leaf[node]);
    for (int c = 0; c < tree.children[node]; ++c) stack.push_back(tree.first_child[node] + c);
  }
  std::sort(found.begin(), found.end());
  return found;
}

using Interval = std::pair<double, double>;  // of angles, within [0, 2 pi]

// Adds the angles from `first` on for `length`, cut at 0.
void add_angles(std::vector<Interval>& intervals, double first, double length) {
  first -= kTurn * std::floor(first / kTurn);
  const double last = first + length;
  intervals.emplace_back(first, std::min(last, kTurn));
  if (last > kTurn) intervals.emplace_back(0.0, last - kTurn);
}

// The angles at which the circle lies in the ball. Returns false if that is all of it.
bool add_covered(const BoundaryArc& circle, const Eigen::Vector4d& ball,
                 std::vector<Interval>& covered) {
  // |p - x|^2 - r^2 = constant + swing cos(angle - phase) for the points p of the circle.
  const Eigen::Vector3d offset = circle.center - ball.head<3>();
  const double along = offset.dot(circle.along), across = offset.dot(circle.across);
  const double swing = 2.0 * circle.radius * std::hypot(along, across);
  const double constant = offset.squaredNorm() + circle.radius * circle.radius - ball[3] * ball[3];
  if (constant >= swing) return true;
  if (constant <= -swing) return false;
  const double half = std::acos(constant / swing);
  add_angles(covered, std::atan2(across, along) + std::numbers::pi - half, 2.0 * half);
  return true;
}

// Appends what of the circle of two balls no third one holds.
void add_arcs(const BallBoundary& boundary, int a, int b, std::vector<BoundaryArc>& arcs) {
  const Eigen::Vector4d first = boundary.balls.col(a), second = boundary.balls.col(b);
  const Eigen::Vector3d way = (second - first).head<3>();
  const double distance = way.norm();
  const double along =
      0.5 * (distance + (first[3] - second[3]) * (first[3] + second[3]) / distance);
  const double radius_sq = (first[3] - along) * (first[3] + along);
  if (!(radius_sq > 0.0)) return;  // they touch
  BoundaryArc circle;
  circle.center = first.head<3>() + along / distance * way;
  circle.radius = std::sqrt(radius_sq);
  circle.along = way.unitOrthogonal();
  circle.across = (way / distance).cross(circle.along);
  std::vector<Interval> covered;
  for (const int k : boundary.neighbors[a])
    if (k != b && !add_covered(circle, boundary.balls.col(k), covered)) return;
  std::sort(covered.begin(), covered.end());
  std::vector<Interval> open;
  double at = 0.0;
  for (const Interval& interval : covered) {
    if (interval.first > at) open.emplace_back(at, interval.first);
    at = std::max(at, interval.second);
  }
  if (at < kTurn) open.emplace_back(at, kTurn);
  for (const Interval& interval : open) {
    circle.start = interval.first;
    circle.length = interval.second - interval.first;
    arcs.push_back(circle);
  }
}

}  // namespace

double BoundaryArc::distance(const Eigen::Vector3d& point) const {
  const Eigen::Vector3d offset = point - center;
  double angle = std::atan2(offset.dot(across), offset.dot(along)) - start;
  angle -= kTurn * std::floor(angle / kTurn);
  // Beyond the arc: the nearer end.
  if (angle > length) angle = angle - length < kTurn - angle ? length : 0.0;
  angle += start;
  return (offset - radius * (std::cos(angle) * along + std::sin(angle) * across)).norm();
}

bool BallBoundary::is_exposed(int ball, const Eigen::Vector3d& point) const {
  return std::none_of(neighbors[ball].begin(), neighbors[ball].end(), [&](int k) {
    const double radius = balls(3, k) * (1.0 - kTolerance);
    return (balls.col(k).head<3>() - point).squaredNorm() < radius * radius;
  });
}

BallBoundary ball_boundary(const Eigen::Matrix4Xd& balls) {
  BallBoundary boundary;
  const std::vector<Eigen::Index> kept = uncontained_balls(balls);
  boundary.balls = balls(Eigen::all, kept);
  boundary.tree = sphere_tree(boundary.balls);
  const auto count = static_cast<int>(kept.size());
  for (int a = 0; a < count; ++a)
    boundary.neighbors.push_back(overlapping(boundary.tree, boundary.balls, a));
  std::vector<char> exposed(kept.size(), 0);
  for (int a = 0; a < count; ++a) {
    if (boundary.neighbors[a].empty()) exposed[a] = 1;
    for (const int b : boundary.neighbors[a]) {
      if (b < a) continue;
      const std::size_t before = boundary.arcs.size();
      add_arcs(boundary, a, b, boundary.arcs);
      // The open part of a sphere that meets others is bounded by arcs: without one there is none.
      if (boundary.arcs.size() > before) exposed[a] = exposed[b] = 1;
    }
  }
  for (int a = 0; a < count; ++a)
    if (exposed[a] != 0) boundary.exposed.push_back(a);
  return boundary;
}

}  // namespace mortise::parts
