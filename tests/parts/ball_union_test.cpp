// SPDX-License-Identifier: GPL-3.0-or-later
// Distances to unions of balls by hand and against dense samples of their boundary.
#include "mortise/parts/ball_union.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "mortise/core/errors.hpp"
#include "mortise/parts/ball_mesh.hpp"
#include "mortise/parts/decompose.hpp"
#include "mortise/parts/hausdorff.hpp"

namespace mortise {
namespace {

double at(const BallUnion& solid, double x, double y, double z) {
  return solid.signed_distance(Eigen::Vector3d(x, y, z), 1.0)[0];
}

TEST(BallUnion, TwoBallsByHand) {
  Eigen::Matrix4Xd balls(4, 2);
  balls.col(0) << 0, 0, 0, 1.0;
  balls.col(1) << 1, 0, 0, 1.0;
  const BallUnion solid(balls);
  // Between the two the nearest points are those of the circle of radius sqrt(3) / 2 at x = 1 / 2.
  EXPECT_NEAR(at(solid, 0.5, 0, 0), -std::sqrt(0.75), 1e-14);
  EXPECT_NEAR(at(solid, 0.5, 0.4, 0), -(std::sqrt(0.75) - 0.4), 1e-14);
  EXPECT_NEAR(at(solid, 0.4, 0, 0.1), -std::hypot(0.1, std::sqrt(0.75) - 0.1), 1e-14);
  EXPECT_NEAR(at(solid, 0, 0, 0), -1.0, 1e-14);
  EXPECT_NEAR(at(solid, -0.3, 0, 0), -0.7, 1e-14);
  EXPECT_NEAR(at(solid, 2.5, 0, 0), 0.5, 1e-14);
  EXPECT_NEAR(at(solid, 0.5, 2.0, 0), std::hypot(0.5, 2.0) - 1.0, 1e-14);
  EXPECT_NEAR(solid.bounds().sizes().x(), 3.0, 1e-14);
}

TEST(BallUnion, ThreeBallsMeetInPoints) {
  // Equal balls about the corners of a triangle: their spheres meet at height h over its middle.
  Eigen::Matrix4Xd balls(4, 3);
  for (int i = 0; i < 3; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / 3.0;
    balls.col(i) << 0.8 * std::cos(angle), 0.8 * std::sin(angle), 0.0, 1.0;
  }
  const BallUnion solid(balls);
  const double height = std::sqrt(1.0 - 0.64);
  EXPECT_NEAR(at(solid, 0, 0, 0), -height, 1e-14);
  EXPECT_NEAR(at(solid, 0, 0, 0.3), -(height - 0.3), 1e-14);
  EXPECT_NEAR(at(solid, 0, 0, 1.0), std::hypot(0.8, 1.0) - 1.0, 1e-14);
}

// Balls within a box, some inside others, some alone.
Eigen::Matrix4Xd random_balls(int count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(-1.0, 1.0), radius(0.1, 0.5);
  Eigen::Matrix4Xd balls(4, count);
  for (int i = 0; i < count; ++i)
    balls.col(i) << 1.5 * place(random), place(random), place(random), radius(random);
  balls.col(count - 1) << 5.0, 0.0, 0.0, 0.3;
  balls.col(count - 2) = balls.col(0);
  return balls;
}

TEST(BallUnion, DepthsAreThoseToASampledBoundary) {
  for (const int count : {5, 20, 60}) {
    const Eigen::Matrix4Xd balls = random_balls(count, static_cast<unsigned>(count));
    const BallUnion solid(balls);
    // Samples of the spheres that no ball holds; the corners of a fine icosahedron.
    constexpr int kCuts = 24;
    const TriangleMesh mesh = ball_mesh(balls, kCuts);
    std::vector<Eigen::Vector3d> samples;
    for (Eigen::Index v = 0; v < mesh.vertices.cols(); ++v) {
      const Eigen::Vector3d p = mesh.vertices.col(v);
      if (((balls.topRows<3>().colwise() - p).colwise().norm() - balls.row(3)).minCoeff() > -1e-9)
        samples.push_back(p);
    }
    const double spacing =
        0.5 * 1.3 / kCuts;  // edges of a ball of radius 1/2 are this long at most
    std::mt19937 random(7);
    std::uniform_real_distribution<double> place(-1.2, 1.2);
    int inside = 0;
    for (int trial = 0; trial < 400; ++trial) {
      const Eigen::Vector3d p(1.5 * place(random), place(random), place(random));
      const double found = at(solid, p.x(), p.y(), p.z());
      const double outside =
          ((balls.topRows<3>().colwise() - p).colwise().norm() - balls.row(3)).minCoeff();
      if (outside >= 0.0) {
        EXPECT_NEAR(found, outside, 1e-14);
        continue;
      }
      ++inside;
      double nearest = std::numeric_limits<double>::infinity();
      for (const Eigen::Vector3d& sample : samples)
        nearest = std::min(nearest, (sample - p).norm());
      EXPECT_LE(-found, nearest + 1e-12);
      EXPECT_GE(-found, nearest - spacing);
      EXPECT_GE(-found, -outside - 1e-12) << "the deepest ball is all inside";
    }
    EXPECT_GT(inside, 10);
  }
}

TEST(BallUnion, DecomposesIntoFewerBalls) {
  // A chain of atoms, as of a molecule.
  Eigen::Matrix4Xd atoms(4, 150);
  std::mt19937 random(3);
  std::normal_distribution<double> step(0.0, 0.9);
  Eigen::Vector3d p = Eigen::Vector3d::Zero();
  for (Eigen::Index i = 0; i < atoms.cols(); ++i) {
    atoms.col(i) << p, 1.7 + 0.2 * std::sin(static_cast<double>(i));
    p = 0.97 * p + Eigen::Vector3d(step(random), step(random), step(random));
  }
  const BallUnion solid(atoms);
  const Decomposition d = decompose(solid, {.grid = 32});
  EXPECT_LT(d.knots.size(), atoms.cols());
  const HausdorffDistance distance = hausdorff_distance(
      d.knots.points, solid, surface_samples(solid, 0.5 * d.spacing), {.spacing = 0.5 * d.spacing});
  EXPECT_LE(distance.of_solids(), d.epsilon * (1.0 + 1e-5));
}

TEST(BallUnion, RefusesWhatIsNoBall) {
  EXPECT_THROW((void)BallUnion(Eigen::Matrix4Xd(4, 0)), InputError);
  EXPECT_THROW((void)BallUnion(Eigen::Matrix4Xd::Zero(4, 1)), InputError);
}

}  // namespace
}  // namespace mortise
