// SPDX-License-Identifier: GPL-3.0-or-later
// Distance grids against the solid asked node by node.
#include "mortise/parts/distance_grid.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "mortise/core/errors.hpp"
#include "mortise/parts/mesh_solid.hpp"
#include "parts/shapes.hpp"

namespace mortise {
namespace {

void expect_same_as_solid(const Solid& solid, const GridNodes& nodes) {
  const DistanceGrid grid = distance_grid(solid, nodes);
  ASSERT_EQ(static_cast<Eigen::Index>(grid.values.size()), nodes.count());
  for (int i = 0; i < nodes.size[0]; ++i)
    for (int j = 0; j < nodes.size[1]; ++j)
      for (int k = 0; k < nodes.size[2]; ++k) {
        const double d =
            solid.signed_distance(nodes.node(i, j, k), std::numeric_limits<double>::infinity())[0];
        const auto index = static_cast<std::size_t>(nodes.index(i, j, k));
        // Bounds from the neighbours may choose another triangle at the same distance.
        ASSERT_NEAR(grid.values[index], d, 1e-6 * std::abs(d) + 1e-14) << i << " " << j << " " << k;
      }
}

TEST(DistanceGrid, IsTheSolidsAnswerAtEveryNode) {
  for (const TriangleMesh& mesh :
       {shapes::cube(), shapes::torus(2.0, 0.7, 40, 24), shapes::noisy_sphere(1.0, 4000, 0.3),
        shapes::without_last(shapes::icosphere(1.0, 6), 60),
        shapes::join(shapes::cube(2.0), shapes::inside_out(shapes::icosphere(0.3, 4)))}) {
    const MeshSolid solid(mesh);
    expect_same_as_solid(solid, grid_around(solid.bounds(), 23, 0.3));
  }
}

TEST(DistanceGrid, HasTheVolumeOfTheBody) {
  const TriangleMesh mesh = shapes::noisy_sphere(1.0, 20000, 0.3);
  const MeshSolid solid(mesh);
  const GridNodes nodes = grid_around(solid.bounds(), 64, 0.05);
  const DistanceGrid grid = distance_grid(solid, nodes);
  Eigen::Index inside = 0;
  for (const float d : grid.values) inside += d < 0 ? 1 : 0;
  // Counting nodes errs by a share of the cells on the boundary.
  EXPECT_NEAR(static_cast<double>(inside) * std::pow(nodes.spacing, 3), shapes::volume(mesh),
              0.005 * shapes::volume(mesh));
}

TEST(DistanceGrid, CoversTheBoxWithItsMargin) {
  const Eigen::AlignedBox3d box(Eigen::Vector3d(1, 2, 3), Eigen::Vector3d(5, 4, 4));
  const GridNodes grid = grid_around(box, 11, 0.5);
  EXPECT_DOUBLE_EQ(grid.spacing, 0.5);
  EXPECT_EQ(grid.size[0], 11);
  EXPECT_EQ(grid.size[1], 7);
  EXPECT_EQ(grid.size[2], 5);
  EXPECT_TRUE(grid.node(0, 0, 0).isApprox(Eigen::Vector3d(0.5, 1.5, 2.5)));
  EXPECT_TRUE(grid.node(10, 6, 4).isApprox(Eigen::Vector3d(5.5, 4.5, 4.5)));
  const GridNodes cubic = cubic_grid_around(box, 11, 0.5);
  EXPECT_TRUE((cubic.size == 11).all());
  EXPECT_TRUE(cubic.node(5, 5, 5).isApprox(box.center()));
}

TEST(DistanceGrid, ThreadsChangeNothing) {
  const MeshSolid solid(shapes::noisy_sphere(1.0, 4000, 0.3));
  const GridNodes nodes = grid_around(solid.bounds(), 25, 0.1);
  EXPECT_EQ(distance_grid(solid, nodes, {.threads = 1}).values,
            distance_grid(solid, nodes, {.threads = 3}).values);
}

TEST(DistanceGrid, RefusesWhatItCannotUse) {
  const MeshSolid solid(shapes::cube());
  EXPECT_THROW((void)grid_around({}, 10, 0.0), InputError);
  EXPECT_THROW((void)grid_around(solid.bounds(), 1, 0.0), InputError);
  EXPECT_THROW((void)grid_around(solid.bounds(), 10, -1.0), InputError);
  GridNodes nodes = grid_around(solid.bounds(), 5, 0.0);
  EXPECT_THROW((void)distance_grid(solid, nodes, {.band = -1.0}), InputError);
  nodes.spacing = 0.0;
  EXPECT_THROW((void)distance_grid(solid, nodes), InputError);
  EXPECT_THROW((void)distance_grid(solid, {}), InputError);
}

}  // namespace
}  // namespace mortise
