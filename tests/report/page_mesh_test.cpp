// SPDX-License-Identifier: GPL-3.0-or-later
// Large parts become small within what is stated; coarse ones are cut up without changing.
#include "report/page_mesh.hpp"

#include <gtest/gtest.h>

#include "closed_mesh.hpp"
#include "mortise/parts/ball_mesh.hpp"
#include "mortise/parts/mesh_solid.hpp"
#include "mortise/parts/sample_surface.hpp"
#include "sample_report.hpp"

namespace mortise::testing {
namespace {

double area(const TriangleMesh& mesh) { return sample_surface(mesh, 1).area; }

TEST(PageMesh, IsSimplifiedWithinTheStatedDeviation) {
  const TriangleMesh ball = ball_mesh(Eigen::Vector4d(100.0, -50.0, 7.0, 2.0), 32);  // 20,480
  ASSERT_EQ(ball.size(), 20'480);
  double last = 0.0;
  for (const Eigen::Index most : {10'000, 2'000, 500}) {
    const detail::SimplifiedMesh made = detail::simplified(ball, most);
    EXPECT_LE(made.mesh.size(), most);
    EXPECT_GT(made.mesh.size(), most / 2);
    EXPECT_TRUE(MeshSolid(made.mesh).closed()) << most;
    EXPECT_GT(made.deviation, last) << "fewer triangles, farther away";
    last = made.deviation;
    // The same by other points, and both ways; a chord's middle lies off the sphere by about
    // (edge / radius)^2 / 8 of the radius.
    const double back =
        MeshSolid(made.mesh).nearest(sample_surface(ball, 7'919).points).distances.maxCoeff();
    EXPECT_LT(back, 1.1 * made.deviation);
    EXPECT_LT(MeshSolid(ball).nearest(sample_surface(made.mesh, 5'000).points).distances.maxCoeff(),
              2.0 * made.deviation);
    const double edge_sq = area(ball) / static_cast<double>(most) * 4.0 / std::sqrt(3.0);
    EXPECT_LT(made.deviation, edge_sq / 2.0);
  }
  EXPECT_EQ(detail::simplified(ball, 20'480).mesh.size(), 20'480);
  EXPECT_EQ(detail::simplified(ball, 20'480).deviation, 0.0);
}

TEST(PageMesh, CutUpIsTheSameSurface) {
  const TriangleMesh plate = plate_and_pin().fixed.mesh;
  const TriangleMesh cut = detail::cut_up(plate, 60'000);
  EXPECT_GT(cut.size(), 10 * plate.size());
  EXPECT_LT(cut.size(), 60'000);
  EXPECT_NEAR(area(cut), area(plate), 1e-9 * area(plate));
  EXPECT_EQ(is_closed(cut), is_closed(plate));
  EXPECT_EQ(cut.vertices.leftCols(plate.vertices.cols()), plate.vertices);
  double longest = 0.0;
  for (Eigen::Index t = 0; t < cut.size(); ++t)
    for (int k = 0; k < 3; ++k)
      longest = std::max(longest, (cut.vertices.col(cut.triangles(k, t)) -
                                   cut.vertices.col(cut.triangles((k + 1) % 3, t)))
                                      .norm());
  const double diagonal = std::sqrt(30.0 * 30.0 + 30.0 * 30.0 + 8.0 * 8.0);
  EXPECT_LE(longest, diagonal / 40.0 * (1.0 + 1e-12));
  EXPECT_EQ(detail::cut_up(plate, plate.size()).size(), plate.size());
  // A budget that is too small for that is kept within a round of cutting.
  EXPECT_LT(detail::cut_up(plate, 1'000).size(), 4'000);
}

}  // namespace
}  // namespace mortise::testing
