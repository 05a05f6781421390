// SPDX-License-Identifier: GPL-3.0-or-later
// Rotations that align faces: each lays two directions of the moving part into two of the fixed
// one's.
#include "runs/mate_directions.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "helpers/random_motions.hpp"

namespace mortise {
namespace {

// A box's six face normals, turned at random: some products with themselves round to more than 1.
Directions turned_box(std::mt19937& random) {
  const Eigen::Quaterniond q = tests::random_rotation(random);
  Directions result;
  for (int axis = 0; axis < 3; ++axis)
    for (const double way : {1.0, -1.0})
      result.normals.emplace_back(
          (q * Eigen::Vector3d(way * Eigen::Vector3d::Unit(axis))).normalized());
  return result;
}

int laid(const Eigen::Quaterniond& q, const Directions& fixed, const Directions& moving) {
  int count = 0;
  for (const Eigen::Vector3d& m : moving.normals)
    for (const Eigen::Vector3d& f : fixed.normals) count += (q * m + f).norm() < 0.05;
  return count;
}

TEST(AlignedRotations, LayAllFacesOfABoxOntoThoseOfAnother) {
  std::mt19937 random{3};
  for (int trial = 0; trial < 50; ++trial) {
    const Directions fixed = turned_box(random), moving = turned_box(random);
    const Eigen::Matrix4Xd rotations = aligned_rotations(fixed, moving, 8, 1000);
    ASSERT_EQ(rotations.cols(), 24);  // of the cube's group, and nothing else
    for (Eigen::Index i = 0; i < rotations.cols(); ++i) {
      const Eigen::Vector4d q = rotations.col(i);
      EXPECT_EQ(laid(Eigen::Quaterniond(q[0], q[1], q[2], q[3]), fixed, moving), 6);
    }
  }
}

}  // namespace
}  // namespace mortise
