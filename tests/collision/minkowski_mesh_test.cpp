// SPDX-License-Identifier: GPL-3.0-or-later
// Sums of decomposed parts against the exact sums of their meshes.
#include <gtest/gtest.h>

#include "mortise/collision/minkowski.hpp"
#include "mortise/parts/decompose.hpp"
#include "mortise/parts/hausdorff.hpp"
#include "mortise/parts/mesh_solid.hpp"
#include "parts/shapes.hpp"
#include "reference/mesh_minkowski.hpp"

namespace mortise {
namespace {

// An L: a square of side 2 in the plane without its upper right quarter, `height` thick.
TriangleMesh l_shape(double height) {
  TriangleMesh mesh;
  mesh.vertices.resize(3, 12);
  const double x[] = {0, 2, 2, 1, 1, 0}, y[] = {0, 0, 1, 1, 2, 2};
  for (int i = 0; i < 6; ++i) {
    mesh.vertices.col(i) << x[i] - 0.7, y[i] - 0.8, -0.5 * height;
    mesh.vertices.col(6 + i) << x[i] - 0.7, y[i] - 0.8, 0.5 * height;
  }
  mesh.triangles.resize(3, 20);
  const int cap[4][3] = {{0, 1, 3}, {1, 2, 3}, {0, 3, 5}, {3, 4, 5}};
  for (int t = 0; t < 4; ++t) {
    mesh.triangles.col(t) << 6 + cap[t][0], 6 + cap[t][1], 6 + cap[t][2];
    mesh.triangles.col(4 + t) << cap[t][0], cap[t][2], cap[t][1];
  }
  for (int i = 0; i < 6; ++i) {
    const int next = (i + 1) % 6;
    mesh.triangles.col(8 + 2 * i) << i, next, 6 + next;
    mesh.triangles.col(9 + 2 * i) << i, 6 + next, 6 + i;
  }
  return mesh;
}

TEST(MinkowskiOfParts, IsWithinBothEpsilonsOfTheExactSum) {
  const TriangleMesh l = l_shape(0.6);
  ASSERT_NEAR(shapes::volume(l), 1.8, 1e-12);
  const TriangleMesh box = shapes::box({0.5, 0.3, 0.8});
  for (const TriangleMesh& second : {box, l_shape(0.4)}) {
    const MeshSolid exact(reference::minkowski_sum(l, second));
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
