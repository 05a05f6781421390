// SPDX-License-Identifier: GPL-3.0-or-later
// Points on the boundary of a solid that its balls must reach beside the nodes inside it.
#pragma once

#include <utility>
#include <vector>

#include "parts/node_field.hpp"

namespace mortise::parts {

// The boundary's nearest points to the nodes of the cells it passes through. The part of a solid in
// the cells of nodes outside may be further than half a cell's diagonal from every node inside,
// which [SD, Lemma 4] overlooks; so balls have to come near these points too.
class BoundaryPoints {
 public:
  explicit BoundaryPoints(const NodeField& field);

  [[nodiscard]] std::size_t size() const { return points_.size(); }
  // How far outside the solid the node of a point lies, spacings; negative inside.
  [[nodiscard]] double outside(std::size_t point) const;
  [[nodiscard]] Eigen::Vector3d node(std::size_t point) const;

  // Calls found(point) for each point that the ball reaches.
  template <typename Found>
  void for_reached(const GridBall& ball, const Found& found) const {
    // The point of a node lies within half a cell's diagonal of it.
    for_rows_in(field_, {ball.center, ball.radius + kReach + kHalfDiagonal},
                [&](std::int64_t first, std::int64_t last) {
                  for (std::int64_t k = first; k <= last; ++k)
                    if (place_[k] >= 0 && reaches(ball, points_[place_[k]]))
                      found(static_cast<std::size_t>(place_[k]));
                });
  }

 private:
  // How near the union of the balls must come to a point, spacings. Where a node inside is near,
  // what lies between the points is then within half a diagonal too (measured, docs/decisions.md).
  // Where there is none, at sheets thinner than a cell, the points alone stand for the solid: they
  // are sqrt(1/2) from what lies between them.
  static constexpr double kReach = 0.5 * kHalfDiagonal;
  static constexpr double kThinReach = kHalfDiagonal - 0.5 * std::numbers::sqrt2;

  struct Point {
    std::int64_t node;
    Eigen::Vector3d position;  // in nodes
    double reach;
  };

  static bool reaches(const GridBall& ball, const Point& point) {
    const double reach = ball.radius + point.reach;
    return (point.position - ball.center).squaredNorm() <= reach * reach;
  }

  const NodeField& field_;
  std::vector<Point> points_;
  std::vector<std::int32_t> place_;  // of each node's point in points_, or -1
};

// Balls to add so that every boundary point is reached: some of `candidates`, else small ones about
// nodes. All radii are grown already, by `growth` spacings.
std::vector<GridBall> boundary_balls(const BoundaryPoints& boundary,
                                     const std::vector<GridBall>& knots,
                                     const std::vector<GridBall>& candidates, double growth);

// The balls without those, smallest first, whose nodes and boundary points others hold and reach.
std::vector<GridBall> without_needless(const NodeField& field, const BoundaryPoints& boundary,
                                       std::vector<GridBall> balls);

}  // namespace mortise::parts
