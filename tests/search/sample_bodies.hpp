// SPDX-License-Identifier: GPL-3.0-or-later
// Small made-up bodies for the tests of the search. Random numbers are drawn in braces, which are
// evaluated in order.
#pragma once

#include <random>
#include <vector>

#include "helpers/random_motions.hpp"
#include "mortise/core/knots.hpp"
#include "mortise/core/rigid_motion.hpp"
#include "mortise/rotations/rotation_set.hpp"

namespace mortise::sample_bodies {

// `count` knots in an ellipsoid with the given half axes about `centre`, radii from `radii` in
// turn.
inline Knots ellipsoid(std::mt19937& random, int count, const Eigen::Vector3d& half,
                       const Eigen::Vector3d& centre, const std::vector<double>& radii,
                       bool complex_weights = false) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Knots knots{Eigen::Matrix4Xd(4, count), Eigen::VectorXcd(count)};
  for (int i = 0; i < count; ++i) {
    Eigen::Vector3d p;
    do p = Eigen::Vector3d{uniform(random), uniform(random), uniform(random)};
    while (p.norm() > 1.0);
    knots.points.col(i) << half.cwiseProduct(p) + centre, radii[i % radii.size()];
    const double re = 1.0 + 0.5 * uniform(random), im = uniform(random);
    knots.weights[i] = complex_weights ? std::complex<double>(re - 1.0, im) : re;
  }
  return knots;
}

inline Knots moved(const RigidMotion& motion, Knots knots) {
  knots.points.topRows<3>() = motion * Eigen::Matrix3Xd(knots.points.topRows<3>());
  return knots;
}

using tests::random_motion;
using tests::random_rotations;

inline Eigen::Quaterniond quaternion(const Eigen::Vector4d& q) { return {q[0], q[1], q[2], q[3]}; }
inline Eigen::Vector4d row_of(const Eigen::Quaterniond& q) { return {q.w(), q.x(), q.y(), q.z()}; }

}  // namespace mortise::sample_bodies
