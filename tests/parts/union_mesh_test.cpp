// SPDX-License-Identifier: GPL-3.0-or-later
// Boundaries of unions of balls against exact distances.
#include "mortise/parts/union_mesh.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "mortise/core/errors.hpp"
#include "mortise/parts/ball_union.hpp"
#include "mortise/parts/mesh_solid.hpp"
#include "parts/envelope_grid.hpp"
#include "parts/shapes.hpp"

namespace mortise {
namespace {

Eigen::Matrix4Xd union_balls(int n, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(-1.0, 1.0), radius(0.1, 0.5);
  Eigen::Matrix4Xd balls(4, n);
  for (auto ball : balls.colwise())
    ball << 2.0 * place(random), place(random), place(random), radius(random);
  return balls;
}

TEST(EnvelopeGrid, IsExactNearZeroAndOfTheRightSignElsewhere) {
  for (const int n : {1, 3, 40}) {
    const Eigen::Matrix4Xd balls = union_balls(n, static_cast<unsigned>(n));
    GridNodes nodes;
    nodes.origin = {-3.0, -2.0, -2.0};
    nodes.spacing = 0.11;
    nodes.size = {55, 37, 30};
    const auto functions = [&](const std::vector<std::int32_t>& which, const Eigen::Vector3d& at,
                               std::vector<double>& values) {
      values.resize(which.size());
      for (std::size_t i = 0; i < which.size(); ++i)
        values[i] = (balls.col(which[i]).head<3>() - at).norm() - balls(3, which[i]);
    };
    const DistanceGrid grid = parts::envelope_grid(nodes, n, 1, functions);
    EXPECT_EQ(grid.values, parts::envelope_grid(nodes, n, 3, functions).values);
    int near = 0;
    for (int i = 0; i < nodes.size[0]; ++i)
      for (int j = 0; j < nodes.size[1]; ++j)
        for (int k = 0; k < nodes.size[2]; ++k) {
          const Eigen::Vector3d at = nodes.node(i, j, k);
          const double exact =
              ((balls.topRows<3>().colwise() - at).colwise().norm() - balls.row(3)).minCoeff();
          const float found = grid.values[static_cast<std::size_t>(nodes.index(i, j, k))];
          if (std::abs(exact) <= nodes.spacing) {
            ++near;
            ASSERT_EQ(found, static_cast<float>(exact));
          } else {
            ASSERT_EQ(found > 0.0F, exact > 0.0);
            ASSERT_GE(std::abs(found), static_cast<float>(nodes.spacing));
          }
        }
    EXPECT_GT(near, 50);
  }
}

TEST(UnionMesh, OfOneBallIsItsSphere) {
  for (const double spacing : {0.3, 0.15}) {
    const Eigen::Vector4d ball(5.0, -3.0, 100.0, 1.0);
    const TriangleMesh mesh = union_mesh(ball, {.spacing = spacing});
    const Eigen::VectorXd distance = (mesh.vertices.colwise() - ball.head<3>()).colwise().norm();
    EXPECT_LT((distance.array() - 1.0).abs().maxCoeff(), spacing * spacing);
    TriangleMesh centred = mesh;
    centred.vertices.colwise() -= ball.head<3>();
    EXPECT_NEAR(shapes::volume(centred), 4.0 / 3.0 * std::numbers::pi,
                4.0 * std::numbers::pi * spacing * spacing);
  }
}

TEST(UnionMesh, KeepsInsideAndOutsideApart) {
  const Eigen::Matrix4Xd balls = union_balls(60, 9);
  const double spacing = 0.05;
  const TriangleMesh mesh = union_mesh(balls, {.spacing = spacing, .threads = 1});
  const TriangleMesh again = union_mesh(balls, {.spacing = spacing, .threads = 3});
  EXPECT_EQ(mesh.vertices, again.vertices);
  EXPECT_EQ(mesh.triangles, again.triangles);
  const BallUnion exact(balls);
  const double all = std::numeric_limits<double>::infinity();
  // A vertex lies in a cell that the boundary cuts.
  EXPECT_LT(exact.signed_distance(mesh.vertices, all).cwiseAbs().maxCoeff(),
            std::sqrt(3.0) * spacing);
  const MeshSolid solid(mesh);
  EXPECT_TRUE(solid.closed());
  std::mt19937 random(10);
  std::uniform_real_distribution<double> place(-1.5, 1.5);
  Eigen::Matrix3Xd points(3, 4000);
  for (auto point : points.colwise()) point << 1.5 * place(random), place(random), place(random);
  const Eigen::VectorXd found = solid.signed_distance(points, all),
                        expected = exact.signed_distance(points, all);
  int inside = 0;
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    if (std::abs(expected[i]) < 2.0 * spacing) continue;
    EXPECT_EQ(found[i] < 0.0, expected[i] < 0.0) << points.col(i).transpose();
    inside += expected[i] < 0.0 ? 1 : 0;
  }
  EXPECT_GT(inside, 300);
}

TEST(UnionMesh, RefusesBadInput) {
  EXPECT_THROW((void)union_mesh(Eigen::Matrix4Xd(4, 0)), InputError);
  Eigen::Matrix4Xd balls = union_balls(3, 1);
  EXPECT_THROW((void)union_mesh(balls, {.spacing = -1.0}), InputError);
  EXPECT_THROW((void)union_mesh(balls, {.spacing = 1e-6}), InputError);
  balls(3, 1) = -1.0;
  EXPECT_THROW((void)union_mesh(balls), InputError);
  balls(3, 1) = std::nan("");
  EXPECT_THROW((void)union_mesh(balls), InputError);
}

}  // namespace
}  // namespace mortise
