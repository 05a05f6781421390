// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A tree of bounding balls over balls, for questions about pairs of bodies.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "mortise/core/rigid_motion.hpp"

namespace mortise {

class BallTree {
 public:
  /// @param balls  4 x N, N >= 1: centres and radii
  /// @param cover  by how much each ball is grown for `outer`
  BallTree(const Eigen::Matrix4Xd& balls, double cover);

  enum class Verdict { kApart, kMeet, kBetween, kStopped };

  /// Do the two bodies' balls meet? kMeet: two balls as they are overlap. kApart: all grown ones
  /// are apart. kBetween: only grown ones meet. kStopped: more than `steps` pairs.
  [[nodiscard]] static Verdict compare(const BallTree& fixed, const BallTree& moving,
                                       const RigidMotion& moving_in_fixed, int steps);

 private:
  struct Node {
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    double radius = 0.0;  // of a ball around all grown balls below
    double inner = 0.0;   // a leaf's own radius
    int left = -1, right = -1;
  };
  int build(const Eigen::Matrix4Xd& balls, double cover, std::vector<int>& order, int first,
            int last);

  std::vector<Node> nodes_;  // the root last
};

}  // namespace mortise
