// SPDX-License-Identifier: GPL-3.0-or-later
// Where a probe in touch with two balls can stand: arcs of a circle.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace mortise::detail {

// Balls grown by the probe's radius: its centre can be wherever it lies in none of them.
struct GrownBalls {
  Eigen::Matrix3Xd centres;  // 3 x N
  Eigen::VectorXd radii;     // N
};

// The circle in which two grown balls meet.
struct ProbeCircle {
  Eigen::Vector3d centre, axis;  // the axis points from ball i to ball j
  Eigen::Vector3d e1, e2;        // e1, e2, axis: right-handed, orthonormal
  double radius = 0.0;
  double from_i = 0.0, from_j = 0.0;  // of the centre, along the axis, away from i and from j

  [[nodiscard]] Eigen::Vector3d radial(double angle) const;
  [[nodiscard]] Eigen::Vector3d at(double angle) const { return centre + radius * radial(angle); }
};

// A free arc from angle `from` to `to`; where it ends, the probe touches a third ball too.
struct ProbeArc {
  double from = 0.0, to = 0.0;                  // from < to <= from + 2 pi
  std::int32_t from_owner = -1, to_owner = -1;  // the balls that end it; -1: the full circle
};

// False if the spheres of i and j do not meet in a circle.
[[nodiscard]] bool probe_circle(const GrownBalls& balls, std::int32_t i, std::int32_t j,
                                ProbeCircle& circle);

// The arcs of i's and j's circle that lie in none of the balls `others` (i and j are passed over).
[[nodiscard]] std::vector<ProbeArc> free_arcs(const GrownBalls& balls, const ProbeCircle& circle,
                                              std::int32_t i, std::int32_t j,
                                              const std::vector<std::int32_t>& others);

}  // namespace mortise::detail
