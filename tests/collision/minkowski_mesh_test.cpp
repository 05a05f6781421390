// SPDX-License-Identifier: GPL-3.0-or-later
// Sums of decomposed parts against the exact sums of their meshes.
#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "mortise/collision/minkowski.hpp"
#include "mortise/parts/decompose.hpp"
#include "mortise/parts/hausdorff.hpp"
#include "mortise/parts/mesh_solid.hpp"
#include "parts/shapes.hpp"

namespace mortise {
namespace {

// A polygon, counter-clockwise and star-shaped about its first corner, `height` thick about z = 0.
TriangleMesh prism(const std::vector<Eigen::Vector2d>& corners, double height) {
  const int n = static_cast<int>(corners.size());
  TriangleMesh mesh;
  mesh.vertices.resize(3, 2 * n);
  mesh.triangles.resize(3, 4 * n - 4);
  for (int i = 0; i < n; ++i) {
    const int next = (i + 1) % n;
    mesh.vertices.col(i) << corners[i], -0.5 * height;
    mesh.vertices.col(n + i) << corners[i], 0.5 * height;
    mesh.triangles.col(2 * i) << i, next, n + next;
    mesh.triangles.col(2 * i + 1) << i, n + next, n + i;
  }
  for (int i = 1; i + 1 < n; ++i) {
    mesh.triangles.col(2 * n + 2 * i - 2) << 0, i + 1, i;
    mesh.triangles.col(2 * n + 2 * i - 1) << n, n + i, n + i + 1;
  }
  return mesh;
}

// A square of side 2 without its upper right quarter, moved to have its lower left corner at `low`.
std::vector<Eigen::Vector2d> l_corners(const Eigen::Vector2d& low) {
  return {low,
          low + Eigen::Vector2d(2, 0),
          low + Eigen::Vector2d(2, 1),
          low + Eigen::Vector2d(1, 1),
          low + Eigen::Vector2d(1, 2),
          low + Eigen::Vector2d(0, 2)};
}

// The sum of prisms of one axis is the prism of the sum of their polygons; that of an L and a
// rectangle, and of two Ls, are unions of sums of rectangles.
TEST(MinkowskiOfParts, IsWithinBothEpsilonsOfTheExactSum) {
  const Eigen::Vector2d low(-0.7, -0.8);
  const TriangleMesh l = prism(l_corners(low), 0.6);
  ASSERT_NEAR(shapes::volume(l), 1.8, 1e-12);
  const TriangleMesh rectangle = prism({{0, 0}, {0.5, 0}, {0.5, 0.3}, {0, 0.3}}, 0.8);
  const TriangleMesh with_rectangle =
      prism({low, low + Eigen::Vector2d(2.5, 0), low + Eigen::Vector2d(2.5, 1.3),
             low + Eigen::Vector2d(1.5, 1.3), low + Eigen::Vector2d(1.5, 2.3),
             low + Eigen::Vector2d(0, 2.3)},
            1.4);
  const TriangleMesh with_itself =
      prism({2 * low, 2 * low + Eigen::Vector2d(4, 0), 2 * low + Eigen::Vector2d(4, 2),
             2 * low + Eigen::Vector2d(3, 2), 2 * low + Eigen::Vector2d(3, 3),
             2 * low + Eigen::Vector2d(2, 3), 2 * low + Eigen::Vector2d(2, 4),
             2 * low + Eigen::Vector2d(0, 4)},
            1.0);
  const std::pair<TriangleMesh, TriangleMesh> cases[] = {{rectangle, with_rectangle},
                                                         {prism(l_corners(low), 0.4), with_itself}};
  for (const auto& [second, expected] : cases) {
    const MeshSolid exact(expected);
    ASSERT_TRUE(exact.closed());
    const Decomposition a = decompose(MeshSolid(l), {.grid = 12});
    const Decomposition b = decompose(MeshSolid(second), {.grid = 10});
    const Balls sum = minkowski_sum(a.knots.points, b.knots.points);
    const Balls few = without_contained(sum);
    EXPECT_LT(few.cols(), sum.cols());
    const double bound = a.epsilon + b.epsilon;
    const HausdorffDistance distance =
        hausdorff_distance(few.cast<double>(), exact, surface_samples(exact.mesh(), 0.4 * bound),
                           {.spacing = 0.4 * bound});
    EXPECT_LE(distance.of_solids(), bound * (1.0 + 1e-5));
    EXPECT_GE(distance.balls_beyond_solid, 0.9 * bound) << "grown balls at both boundaries add up";
  }
}

}  // namespace
}  // namespace mortise
