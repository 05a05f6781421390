// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Rigid motions x' = R x + t.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace mortise {

/// The rigid motion x' = R x + t, R a unit quaternion with w >= 0.
struct RigidMotion {
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();

  [[nodiscard]] Eigen::Vector3d operator*(const Eigen::Vector3d& x) const {
    return rotation * x + translation;
  }
  /// Moves every column of `points` (3 x N).
  [[nodiscard]] Eigen::Matrix3Xd operator*(const Eigen::Matrix3Xd& points) const {
    return (rotation.toRotationMatrix() * points).colwise() + translation;
  }
};

/// @throws InputError "<who>: ..." unless the translation is finite and the quaternion of unit norm
/// to 1e-6
void check_motion(const RigidMotion& motion, const char* who);

/// The same rotation with unit norm and w >= 0 (for w = 0: the first nonzero of x, y, z positive).
[[nodiscard]] Eigen::Quaterniond canonical(const Eigen::Quaterniond& q);

/// a after b: x -> a (b x).
[[nodiscard]] RigidMotion compose(const RigidMotion& a, const RigidMotion& b);

[[nodiscard]] RigidMotion inverse(const RigidMotion& m);

/// Angle of the rotation that carries a to b, radians in [0, pi].
[[nodiscard]] double rotation_angle(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b);

}  // namespace mortise
