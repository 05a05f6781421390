// SPDX-License-Identifier: GPL-3.0-or-later
// Random rotations and motions. Numbers are drawn in an order that all compilers agree on: unlike
// arguments in parentheses those in braces are evaluated one after the other.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <random>

#include "mortise/core/rigid_motion.hpp"

namespace mortise::tests {

template <class Random>
Eigen::Vector3d random_vector(Random& random) {
  std::normal_distribution<double> normal;
  return Eigen::Vector3d{normal(random), normal(random), normal(random)};
}

/// All rotations alike.
template <class Random>
Eigen::Quaterniond random_rotation(Random& random) {
  std::normal_distribution<double> normal;
  const Eigen::Vector4d xyzw{normal(random), normal(random), normal(random), normal(random)};
  return canonical(Eigen::Quaterniond(xyzw));
}

/// 4 x count: rows w, x, y, z.
template <class Random>
Eigen::Matrix4Xd random_rotations(Random& random, Eigen::Index count) {
  Eigen::Matrix4Xd result(4, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Eigen::Quaterniond q = random_rotation(random);
    result.col(i) << q.w(), q.x(), q.y(), q.z();
  }
  return result;
}

/// Any rotation and a step of about `step`.
template <class Random>
RigidMotion random_motion(Random& random, double step) {
  const Eigen::Quaterniond q = random_rotation(random);
  return {q, step * random_vector(random)};
}

/// Turned by `angle` about any axis, then a step of about `step`.
template <class Random>
RigidMotion random_turn(Random& random, double angle, double step) {
  const Eigen::Vector3d axis = random_vector(random).normalized();
  return {canonical(Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis))),
          step * random_vector(random)};
}

}  // namespace mortise::tests
