// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Random bodies and poses for tests of the gap function.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <random>

#include "helpers/random_motions.hpp"
#include "mortise/core/knots.hpp"
#include "mortise/core/rigid_motion.hpp"
#include "mortise/core/rotation_vector.hpp"

namespace mortise::tests {

/// `count` balls of radii 0.5 to 1.5 in a cloud of the given radius around `centre`, weights in
/// [0.5, 1.5].
inline Knots random_knots(int count, double reach, const Eigen::Vector3d& centre, unsigned seed,
                          bool complex = false) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Knots knots{Eigen::Matrix4Xd(4, count), Eigen::VectorXcd(count)};
  for (int i = 0; i < count; ++i) {
    Eigen::Vector3d p;
    do p << uniform(random), uniform(random), uniform(random);
    while (p.norm() > 1.0);
    knots.points.col(i) << centre + reach * p, 1.0 + 0.5 * uniform(random);
    knots.weights[i] = {1.0 + 0.5 * uniform(random), complex ? uniform(random) : 0.0};
  }
  return knots;
}

/// A pose that brings the centres (given in the bodies' frames) to a random distance up to `reach`.
inline RigidMotion random_pose(const Eigen::Vector3d& fixed_centre,
                               const Eigen::Vector3d& moving_centre, double reach,
                               std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Eigen::Vector3d step;
  do step << uniform(random), uniform(random), uniform(random);
  while (step.norm() > 1.0);
  RigidMotion pose{random_rotation(random), Eigen::Vector3d::Zero()};
  pose.translation = fixed_centre + reach * step - pose.rotation * moving_centre;
  return pose;
}

/// The pose turned by e (about the moving body's origin, fixed frame) and shifted by d.
inline RigidMotion nudged(const RigidMotion& pose, const Eigen::Vector3d& d,
                          const Eigen::Vector3d& e) {
  return {rotation_from_vector(e) * pose.rotation, pose.translation + d};
}

}  // namespace mortise::tests
