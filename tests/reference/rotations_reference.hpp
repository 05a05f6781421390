// SPDX-License-Identifier: GPL-3.0-or-later
// Slow, plain answers to questions about rotation sets, to compare the library with.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "mortise/core/rigid_motion.hpp"

namespace mortise::reference {

inline Eigen::Quaterniond column(const Eigen::Matrix4Xd& quaternions, Eigen::Index i) {
  return {quaternions(0, i), quaternions(1, i), quaternions(2, i), quaternions(3, i)};
}

/// Angle from `q` to the nearest column, by trying all.
inline double distance(const Eigen::Matrix4Xd& quaternions, const Eigen::Quaterniond& q) {
  double least = std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i < quaternions.cols(); ++i)
    least = std::min(least, rotation_angle(q, column(quaternions, i)));
  return least;
}

/// The covering radius in radians, by trying the circumcentre of every four of the 2 N quaternions
/// +-q: the farthest rotation is one of them if the set spans R^4. O(N^5).
inline double covering_radius(const Eigen::Matrix4Xd& quaternions) {
  const Eigen::Index n = 2 * quaternions.cols();
  Eigen::Matrix4Xd points(4, n);
  points << quaternions, -quaternions;
  double least_cos = 1.0;
  Eigen::Matrix4d rows;
  for (Eigen::Index a = 0; a < n; ++a)
    for (Eigen::Index b = a + 1; b < n; ++b)
      for (Eigen::Index c = b + 1; c < n; ++c)
        for (Eigen::Index d = c + 1; d < n; ++d) {
          rows << points.col(a).transpose(), points.col(b).transpose(), points.col(c).transpose(),
              points.col(d).transpose();
          if (std::abs(rows.determinant()) < 1e-9) continue;
          const Eigen::Vector4d x = (rows.inverse() * Eigen::Vector4d::Ones()).normalized();
          const double cosine = x.dot(points.col(a));
          if (cosine >= least_cos) continue;
          if ((points.transpose() * x).maxCoeff() <= cosine + 1e-12) least_cos = cosine;
        }
  return 2.0 * std::acos(least_cos);
}

}  // namespace mortise::reference
