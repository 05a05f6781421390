// SPDX-License-Identifier: GPL-3.0-or-later
// Distances to the boundary of a union of balls.
#include "mortise/parts/ball_union.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "mortise/core/errors.hpp"
#include "parts/ball_boundary.hpp"

namespace mortise {
namespace {

using parts::BallBoundary;

// A tree over the pieces of the boundary. Each piece, patch or arc, lies on a sphere about some
// centre: its own, or the circle's.
class PieceTree {
 public:
  explicit PieceTree(const BallBoundary& boundary) : boundary_(boundary) {
    for (const int ball : boundary.exposed)
      pieces_.push_back({boundary.balls.col(ball).head<3>(), boundary.balls(3, ball), ball, -1});
    for (std::size_t arc = 0; arc < boundary.arcs.size(); ++arc)
      pieces_.push_back(
          {boundary.arcs[arc].center, boundary.arcs[arc].radius, -1, static_cast<int>(arc)});
    nodes_.reserve(2 * pieces_.size());
    build(0, static_cast<int>(pieces_.size()));
  }

  [[nodiscard]] double distance(const Eigen::Vector3d& point) const {
    double best = std::numeric_limits<double>::infinity();
    search(0, point, best);
    return best;
  }

 private:
  struct Piece {
    Eigen::Vector3d center;
    double radius;
    int ball, arc;  // one of them -1
  };
  struct Node {
    Eigen::Vector3d center;                   // of the pieces' centres
    double spread = 0.0;                      // how far these are from it
    double least_radius = 0.0, radius = 0.0;  // of the pieces
    int first = 0, last = 0, right = -1;      // pieces; the left child follows its parent
  };
  static constexpr int kLeaf = 4;

  int build(int first, int last) {
    const auto index = static_cast<int>(nodes_.size());
    Eigen::AlignedBox3d box;
    for (int i = first; i < last; ++i) box.extend(pieces_[i].center);
    Node node;
    node.center = box.center();
    node.first = first;
    node.last = last;
    node.least_radius = std::numeric_limits<double>::infinity();
    for (int i = first; i < last; ++i) {
      node.spread = std::max(node.spread, (pieces_[i].center - node.center).norm());
      node.least_radius = std::min(node.least_radius, pieces_[i].radius);
      node.radius = std::max(node.radius, pieces_[i].radius);
    }
    nodes_.push_back(node);
    if (last - first <= kLeaf) return index;
    // Along the longest side, radii counting as one: patches of balls and arcs differ most there.
    Eigen::Index axis = 0;
    const double longest = box.sizes().maxCoeff(&axis);
    const bool by_radius = node.radius - node.least_radius > longest;
    const auto key = [&](const Piece& p) { return by_radius ? p.radius : p.center[axis]; };
    const int middle = (first + last) / 2;
    std::nth_element(pieces_.begin() + first, pieces_.begin() + middle, pieces_.begin() + last,
                     [&](const Piece& a, const Piece& b) { return key(a) < key(b); });
    build(first, middle);
    const int right = build(middle, last);
    nodes_[index].right = right;
    return index;
  }

  // No piece of the node is nearer than this.
  [[nodiscard]] double bound(const Node& node, const Eigen::Vector3d& point) const {
    const double way = (point - node.center).norm();
    return std::max({0.0, way - node.spread - node.radius, node.least_radius - way - node.spread});
  }

  [[nodiscard]] double distance(const Piece& piece, const Eigen::Vector3d& point,
                                double best) const {
    constexpr double kNone = std::numeric_limits<double>::infinity();
    const Eigen::Vector3d offset = point - piece.center;
    const double way = offset.norm(), least = std::abs(way - piece.radius);
    if (least >= best) return kNone;
    if (piece.arc >= 0) return boundary_.arcs[piece.arc].distance(point);
    // The nearest point of the sphere, if it is open; else an arc is nearer than the patch.
    if (way == 0.0) return least;
    return boundary_.is_exposed(piece.ball, piece.center + piece.radius / way * offset) ? least
                                                                                        : kNone;
  }

  void search(int index, const Eigen::Vector3d& point, double& best) const {
    const Node& node = nodes_[index];
    if (node.right < 0) {
      for (int i = node.first; i < node.last; ++i)
        best = std::min(best, distance(pieces_[i], point, best));
      return;
    }
    int near = index + 1, far = node.right;
    double near_bound = bound(nodes_[near], point), far_bound = bound(nodes_[far], point);
    if (far_bound < near_bound) {
      std::swap(near, far);
      std::swap(near_bound, far_bound);
    }
    if (near_bound < best) search(near, point, best);
    if (far_bound < best) search(far, point, best);
  }

  const BallBoundary& boundary_;
  std::vector<Piece> pieces_;
  std::vector<Node> nodes_;
};

}  // namespace

struct BallUnion::State {
  explicit State(const Eigen::Matrix4Xd& balls)
      : boundary(parts::ball_boundary(balls)), pieces(boundary) {}

  BallBoundary boundary;
  PieceTree pieces;
};

BallUnion::BallUnion(const Eigen::Matrix4Xd& balls) {
  if (balls.cols() == 0) throw InputError("BallUnion: at least one ball expected, got none");
  if (!balls.allFinite() || !(balls.row(3).array() > 0.0).all())
    throw InputError("BallUnion: balls must be finite with radii > 0");
  state_ = std::make_shared<const State>(balls);
}

Eigen::AlignedBox3d BallUnion::bounds() const {
  const Eigen::Matrix4Xd& balls = state_->boundary.balls;
  const auto radii = balls.row(3).replicate<3, 1>();
  return {(balls.topRows<3>() - radii).rowwise().minCoeff(),
          (balls.topRows<3>() + radii).rowwise().maxCoeff()};
}

Eigen::VectorXd BallUnion::signed_distance(const Eigen::Matrix3Xd& points, double /*band*/) const {
  Eigen::VectorXd result = distance_to_union(state_->boundary.tree, points, 1);
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    if (result[i] < 0.0) result[i] = -state_->pieces.distance(points.col(i));
  return result;
}

}  // namespace mortise
