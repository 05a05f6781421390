// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A tree of bounding balls over balls, for questions about pairs of bodies.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "mortise/core/rigid_motion.hpp"

namespace mortise {

class BallTree {
 public:
  /// @param balls   4 x N, N >= 1: centres and radii
  /// @param margin  by how much each ball is cut back for its inner one, which may leave nothing
  BallTree(const Eigen::Matrix4Xd& balls, double margin);

  enum class Verdict { kApart, kMeet, kBetween, kStopped };

  /// Do the two bodies' balls meet? kMeet: two inner ones overlap. kApart: all are apart. kBetween:
  /// two meet, but no inner ones among the pairs looked at. kStopped: nothing was found in the
  /// first `steps` pairs, and no more were looked at.
  [[nodiscard]] static Verdict compare(const BallTree& fixed, const BallTree& moving,
                                       const RigidMotion& moving_in_fixed, std::int64_t steps);

 private:
  struct Node {
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    double radius = 0.0;  // of a ball around all balls below
    double inner = 0.0;   // of a leaf's inner ball; none if not > 0
    int left = -1, right = -1;
  };
  int build(const Eigen::Matrix4Xd& balls, double margin, std::vector<int>& order, int first,
            int last);

  std::vector<Node> nodes_;  // the root last
  double extent_ = 0.0;      // no coordinate of a ball's points is larger
};

}  // namespace mortise
