// SPDX-License-Identifier: GPL-3.0-or-later
// Spherical decompositions: the propositions of the paper, by dense sampling of simple solids.
#include "mortise/parts/decompose.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "mortise/core/errors.hpp"
#include "mortise/parts/analytic_solids.hpp"
#include "mortise/parts/uncontained_balls.hpp"

namespace mortise {
namespace {

using Shape = std::shared_ptr<const Solid>;

Shape slanted_capsule() { return make_capsule({-1.0, -0.4, 0.2}, {1.1, 0.7, 0.5}, 0.31); }
Shape torus() { return make_torus({0.3, -0.2, 0.1}, 1.0, 0.33); }
Shape box() { return make_box({-0.5, -0.31, -0.77}, {0.4, 0.52, 0.6}); }
Shape dumbbell() {
  return unite({make_ball({-1, 0, 0}, 0.6), make_ball({1, 0.1, 0}, 0.45),
                make_capsule({-1, 0, 0}, {1, 0.1, 0}, 0.12)});
}

// Points of the box of the solid, n along the longest side, in general position.
Eigen::Matrix3Xd box_points(const Solid& solid, int n) {
  const Eigen::AlignedBox3d box = solid.bounds();
  const double step = box.sizes().maxCoeff() / n;
  const Eigen::Array3i size = (box.sizes() / step).array().ceil().cast<int>();
  Eigen::Matrix3Xd points(3, size.prod());
  Eigen::Index i = 0;
  for (int x = 0; x < size.x(); ++x)
    for (int y = 0; y < size.y(); ++y)
      for (int z = 0; z < size.z(); ++z)
        points.col(i++) = box.min() + step * Eigen::Vector3d(x + 0.317, y + 0.561, z + 0.439);
  return points;
}

// Distance to the union of balls, 0 inside, by looking at all of them.
double distance_to_union(const Eigen::Matrix4Xd& balls, const Eigen::Vector3d& p) {
  const Eigen::ArrayXd d = (balls.topRows<3>().colwise() - p).colwise().norm().transpose();
  return std::max(0.0, (d - balls.row(3).transpose().array()).minCoeff());
}

// The largest way from a sampled point of the solid to the union.
double solid_beyond(const Solid& solid, const Eigen::Matrix4Xd& balls, int samples) {
  const Eigen::Matrix3Xd points = box_points(solid, samples);
  const Eigen::VectorXd depth = solid.signed_distance(points, 1e9);
  double most = 0.0;
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    if (depth[i] <= 0.0) most = std::max(most, distance_to_union(balls, points.col(i)));
  return most;
}

// The largest way from a point of a ball's sphere to the solid.
double balls_beyond(const Solid& solid, const Eigen::Matrix4Xd& balls) {
  constexpr int kPoints = 300;
  Eigen::Matrix3Xd sphere(3, kPoints);
  for (int i = 0; i < kPoints; ++i) {
    const double z = 1.0 - (2.0 * i + 1.0) / kPoints, angle = i * std::numbers::pi * 2.399963;
    const double s = std::sqrt(1.0 - z * z);
    sphere.col(i) << s * std::cos(angle), s * std::sin(angle), z;
  }
  double most = 0.0;
  for (Eigen::Index k = 0; k < balls.cols(); ++k) {
    const Eigen::Matrix3Xd points =
        (balls(3, k) * sphere).colwise() + Eigen::Vector3d(balls.col(k).head<3>());
    most = std::max(most, solid.signed_distance(points, 1e9).maxCoeff());
  }
  return most;
}

struct Case {
  std::string name;
  Shape solid;
};

std::vector<Case> cases() {
  return {{"capsule", slanted_capsule()},
          {"torus", torus()},
          {"box", box()},
          {"dumbbell", dumbbell()},
          {"ball", make_ball({0.1, 0.2, 0.3}, 1.0)}};
}

constexpr std::array kMethods = {DecomposeMethod::kSkeletal, DecomposeMethod::kInnerPacking,
                                 DecomposeMethod::kOctree};
constexpr std::array kReductions = {Reduction::kCover, Reduction::kContainment, Reduction::kNone};

TEST(Decompose, Proposition1InnerBallsLieInTheSolidAndHoldEveryNode) {
  for (const Case& c : cases())
    for (const DecomposeMethod method : kMethods) {
      SCOPED_TRACE(c.name + " method " + std::to_string(static_cast<int>(method)));
      const Decomposition d = decompose(*c.solid, {.method = method, .grid = 20, .threads = 1});
      // Depths are kept in single precision.
      EXPECT_LE(balls_beyond(*c.solid, d.inner), 1e-5);
      EXPECT_LE(solid_beyond(*c.solid, d.inner, 47), d.epsilon);
    }
}

TEST(Decompose, Propositions2And3KnotsAreWithinEpsilonOfTheSolid) {
  for (const Case& c : cases())
    for (const DecomposeMethod method : kMethods)
      for (const Reduction reduction : kReductions) {
        SCOPED_TRACE(c.name + " method " + std::to_string(static_cast<int>(method)) +
                     " reduction " + std::to_string(static_cast<int>(reduction)));
        const Decomposition d = decompose(
            *c.solid, {.method = method, .reduction = reduction, .grid = 20, .threads = 1});
        EXPECT_LE(balls_beyond(*c.solid, d.knots.points), d.epsilon * (1 + 1e-5));
        EXPECT_LE(solid_beyond(*c.solid, d.knots.points, 47), d.epsilon);
        EXPECT_EQ(d.coverage, 1.0);
        EXPECT_LE(d.knots.size(), d.inner.cols());
      }
}

}  // namespace
}  // namespace mortise
