// SPDX-License-Identifier: GPL-3.0-or-later
// Centroid and inertia of the moving body.
#include "mortise/core/pose_distance.hpp"

#include <cmath>

#include "mortise/core/errors.hpp"

namespace mortise {

PoseDistance::PoseDistance(const Eigen::Matrix3Xd& points)
    : PoseDistance(points, Eigen::VectorXd::Ones(points.cols())) {}

PoseDistance::PoseDistance(const Eigen::Matrix3Xd& points, const Eigen::VectorXd& weights) {
  if (points.cols() == 0) throw InputError("PoseDistance: expected at least one point, got none");
  if (!points.allFinite())
    throw InputError("PoseDistance: expected finite coordinates, got one that is not");
  const double total = weights.sum();
  if (weights.size() != points.cols() || !(total > 0.0) || !(weights.minCoeff() >= 0.0))
    throw InputError("PoseDistance: expected one weight >= 0 per point, not all 0");
  centroid_ = points * weights / total;
  const Eigen::Matrix3Xd p = points.colwise() - centroid_;
  const Eigen::Matrix3d second = p * weights.asDiagonal() * p.transpose() / total;
  inertia_ = second.trace() * Eigen::Matrix3d::Identity() - second;
}

double PoseDistance::rmsd(const RigidMotion& a, const RigidMotion& b) const {
  return std::sqrt(mean_square(a, b));
}

}  // namespace mortise
