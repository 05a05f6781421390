// SPDX-License-Identifier: GPL-3.0-or-later
// What the boundary of a union of balls is made of.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "mortise/parts/sphere_tree.hpp"

namespace mortise::parts {

// An arc of the circle in which two spheres meet, outside of all other balls.
struct BoundaryArc {
  Eigen::Vector3d center, along, across;  // of the circle; unit vectors to angles 0 and pi / 2
  double radius = 0.0;
  double start = 0.0, length = 0.0;  // angles; from 0 to 2 pi

  [[nodiscard]] double distance(const Eigen::Vector3d& point) const;
};

struct BallBoundary {
  Eigen::Matrix4Xd balls;                   // none inside another
  SphereTree tree;                          // over them
  std::vector<std::vector<int>> neighbors;  // of each ball: those it overlaps
  std::vector<int> exposed;                 // balls of whose spheres a part is on the boundary
  std::vector<BoundaryArc> arcs;

  // Whether a point of a ball's sphere lies in no other ball.
  [[nodiscard]] bool is_exposed(int ball, const Eigen::Vector3d& point) const;
};

// The boundary of the union of balls, 4 x N, N >= 1.
BallBoundary ball_boundary(const Eigen::Matrix4Xd& balls);

}  // namespace mortise::parts
