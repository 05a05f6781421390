// SPDX-License-Identifier: GPL-3.0-or-later
// Principal frames: a box by hand, the same shape however it lies, shapes too symmetric to tell.
#include "mortise/core/principal_frame.hpp"

#include <gtest/gtest.h>

#include <random>

#include "helpers/random_motions.hpp"
#include "mortise/core/errors.hpp"

namespace mortise {
namespace {

TEST(PrincipalFrame, LongestAxisFirstAndTheMiddleOfTheBoxAtTheOrigin) {
  // Longest along y, then z; most points at the ends of low y and high z, so that the far ones of y
  // lie above their mean and those of z below.
  Eigen::Matrix3Xd points(3, 6);
  points << 1, 1, 1, 1, 1, 1.5,  //
      0, 0, 0, 9, 0, 0,          //
      5, 5, 5, 5, 2, 5;
  const RigidMotion frame = principal_frame(points);
  const Eigen::Matrix3Xd turned = frame * points;
  EXPECT_LT((turned.rowwise().minCoeff() + turned.rowwise().maxCoeff()).norm(), 1e-12);
  const Eigen::Vector3d extent = turned.rowwise().maxCoeff() - turned.rowwise().minCoeff();
  EXPECT_GT(extent[0], extent[1]);
  EXPECT_GT(extent[1], extent[2]);
  EXPECT_GT((frame.rotation * Eigen::Vector3d::UnitY())[0], 0.9);
  EXPECT_LT((frame.rotation * Eigen::Vector3d::UnitZ())[1], -0.9);
  EXPECT_NEAR(frame.rotation.toRotationMatrix().determinant(), 1.0, 1e-12);
}

TEST(PrincipalFrame, DependsOnTheShapeAlone) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  Eigen::Matrix3Xd points(3, 200);
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    points.col(i) << 9.0 * std::pow(normal(random), 2), 4.0 * normal(random) * normal(random),
        normal(random);
  const Eigen::Matrix3Xd first = principal_frame(points) * points;
  for (int n = 0; n < 10; ++n) {
    const RigidMotion motion{tests::random_rotation(random),
                             {5.0 * normal(random), normal(random), 40.0}};
    const Eigen::Matrix3Xd moved = motion * points;
    EXPECT_LT((principal_frame(moved) * moved - first).cwiseAbs().maxCoeff(), 1e-9);
  }
}

TEST(PrincipalFrame, SymmetricShapesKeepTheirLargestComponentsPositive) {
  Eigen::Matrix3Xd points(3, 4);
  points << 0, 0, -3, 3, -7, 7, 0, 0, 0, 0, 0, 0;
  const RigidMotion frame = principal_frame(points);
  EXPECT_GT((frame.rotation * Eigen::Vector3d::UnitY())[0], 0.999);
  EXPECT_GT((frame.rotation * Eigen::Vector3d::UnitX())[1], 0.999);
  EXPECT_THROW((void)principal_frame(Eigen::Matrix3Xd(3, 0)), InputError);
}

}  // namespace
}  // namespace mortise
