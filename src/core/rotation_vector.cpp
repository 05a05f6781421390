// SPDX-License-Identifier: GPL-3.0-or-later
// The exponential map of SO(3), and the shortest way between two directions.
#include "mortise/core/rotation_vector.hpp"

namespace mortise {

Eigen::Quaterniond rotation_from_vector(const Eigen::Vector3d& vector) {
  const double angle = vector.norm();
  return angle > 0.0 ? Eigen::Quaterniond(Eigen::AngleAxisd(angle, vector / angle))
                     : Eigen::Quaterniond::Identity();
}

// Eigen's Quaternion::FromTwoVectors finds the axis of a half turn by a singular value
// decomposition, which takes a compiler eight seconds wherever it is used.
Eigen::Quaterniond rotation_between(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  const Eigen::Vector3d a = from.normalized(), b = to.normalized();
  // Half way, from the larger of a + b and a - b: the smaller one has lost its digits where it is
  // short.
  const Eigen::Vector3d sum = a + b, difference = a - b;
  if (sum.squaredNorm() >= difference.squaredNorm()) {
    const Eigen::Vector3d half = sum.normalized();
    const Eigen::Vector3d v = a.cross(half);
    return Eigen::Quaterniond(a.dot(half), v[0], v[1], v[2]).normalized();
  }
  // To the opposite of b first, which is near, then by a half turn about an axis across b.
  const Eigen::Vector3d half = difference.normalized(), v = a.cross(half);
  const Eigen::Quaterniond near(a.dot(half), v[0], v[1], v[2]);
  const Eigen::Vector3d axis = v.squaredNorm() > 1e-16
                                   ? Eigen::Vector3d((v - v.dot(b) * b).normalized())
                                   : b.unitOrthogonal();
  return (Eigen::Quaterniond(0.0, axis[0], axis[1], axis[2]) * near).normalized();
}

}  // namespace mortise
