// SPDX-License-Identifier: GPL-3.0-or-later
// Distances between balls and solids where they are known.
#include "mortise/parts/hausdorff.hpp"

#include <gtest/gtest.h>

#include "mortise/core/errors.hpp"
#include "mortise/parts/ball_mesh.hpp"
#include "mortise/parts/mesh_solid.hpp"
#include "parts/shapes.hpp"
#include "reference/analytic_solids.hpp"

namespace mortise {
namespace {

Eigen::Matrix4Xd one_ball(double x, double radius) { return Eigen::Vector4d(x, 0.0, 0.0, radius); }

TEST(Hausdorff, OfTwoBallsIsTheirCentresDistanceAndDifferenceOfRadii) {
  const auto solid = reference::make_ball({0, 0, 0}, 1.0);
  const double spacing = 0.02;
  const Eigen::Matrix3Xd surface = surface_samples(*solid, spacing, 2);
  const HausdorffDistance same =
      hausdorff_distance(one_ball(0.0, 1.0), *solid, surface, {.spacing = spacing});
  EXPECT_LE(same.of_solids(), 1e-4 * spacing);
  EXPECT_LE(same.of_surfaces(), spacing);

  // Shifted by a, radius 1 + b: each end a + b and a - b beyond.
  const HausdorffDistance d =
      hausdorff_distance(one_ball(0.3, 1.1), *solid, surface, {.spacing = spacing});
  EXPECT_NEAR(d.balls_beyond_solid, 0.4, spacing);
  EXPECT_LE(d.balls_beyond_solid, 0.4 + 1e-12);
  EXPECT_NEAR(d.solid_beyond_balls, 0.2, spacing);
  EXPECT_LE(d.solid_beyond_balls, 0.2 + 1e-3 * spacing);
  EXPECT_NEAR(d.balls_to_surface, 0.4, spacing);
  EXPECT_NEAR(d.surface_to_balls, 0.4, 2.0 * spacing);
  EXPECT_EQ(d.of_solids(), d.balls_beyond_solid);
  EXPECT_GT(d.samples, 10000);
}

TEST(Hausdorff, OfSurfacesSeesAVoidThatThatOfSolidsHardlyDoes) {
  // A shell of balls around the middle of a ball: the void reaches 0.14 from its middle.
  const TriangleMesh sphere = ball_mesh(one_ball(0.0, 0.6), 6);
  Eigen::Matrix4Xd balls(4, sphere.vertices.cols());
  balls.topRows<3>() = sphere.vertices;
  balls.row(3).setConstant(0.4);
  const auto solid = reference::make_ball({0, 0, 0}, 1.0);
  const HausdorffDistance d =
      hausdorff_distance(balls, *solid, surface_samples(*solid, 0.05), {.spacing = 0.05});
  EXPECT_LE(d.balls_beyond_solid, 1e-9);
  EXPECT_NEAR(d.solid_beyond_balls, 0.2, 0.1);
  EXPECT_GE(d.balls_to_surface, 0.79);
}

// A ball of radius 1 with a hollow of radius 0.6.
class HollowBall : public Solid {
 public:
  [[nodiscard]] Eigen::AlignedBox3d bounds() const override {
    return {Eigen::Vector3d::Constant(-1.0), Eigen::Vector3d::Constant(1.0)};
  }
  [[nodiscard]] Eigen::VectorXd signed_distance(const Eigen::Matrix3Xd& points,
                                                double) const override {
    const Eigen::ArrayXd r = points.colwise().norm().transpose();
    return (r - 1.0).max(0.6 - r);
  }
};

TEST(Hausdorff, OfBallsThatFillACavityIsFromItsMiddle) {
  // One ball over all of a ball with a hollow of radius 0.6: its own boundary is on the solid's.
  const HollowBall solid;
  const HausdorffDistance d = hausdorff_distance(one_ball(0.0, 1.0), solid,
                                                 surface_samples(solid, 0.05), {.spacing = 0.05});
  EXPECT_LE(d.balls_beyond_solid, 0.6 + 1e-9);
  EXPECT_GE(d.balls_beyond_solid, 0.6 - 0.87 * d.node_spacing);
  EXPECT_NEAR(d.node_spacing, 0.1, 1e-12);
  EXPECT_LE(d.balls_to_surface, 1e-6);
}

TEST(Hausdorff, SaysHowFarApartItsNodesAre) {
  const auto solid = reference::make_box({0, 0, 0}, {10.0, 0.011, 0.011});
  const HausdorffDistance d = hausdorff_distance(Eigen::Vector4d(5, 0, 0, 0.02), *solid,
                                                 Eigen::Vector3d(0, 0, 0), {.spacing = 0.005});
  EXPECT_EQ(d.spacing, 0.005);
  EXPECT_NEAR(d.node_spacing, 10.0 / 512, 1e-12);  // not the 0.01 asked for
}

TEST(Hausdorff, OfMeshesSamplesEveryTriangle) {
  const TriangleMesh cube = shapes::cube(2.0);
  const Eigen::Matrix3Xd samples = surface_samples(cube, 0.1);
  EXPECT_NEAR(samples.cwiseAbs().colwise().maxCoeff().minCoeff(), 1.0, 1e-12);
  // No point of the surface further than the spacing from a sample.
  double most = 0.0;
  for (double u = -1.0; u <= 1.0; u += 0.037)
    for (double v = -1.0; v <= 1.0; v += 0.041)
      most = std::max(most,
                      (samples.colwise() - Eigen::Vector3d(u, v, 1.0)).colwise().norm().minCoeff());
  EXPECT_LE(most, 0.1);
  EXPECT_GE(most, 0.03);
  const MeshSolid solid(cube);
  const HausdorffDistance d =
      hausdorff_distance(one_ball(0.0, 1.0), solid, samples, {.spacing = 0.05});
  EXPECT_NEAR(d.solid_beyond_balls, std::sqrt(3.0) - 1.0, 1e-12);
  EXPECT_LE(d.balls_beyond_solid, 1e-12);
}

TEST(Hausdorff, SamplesOfASolidLieOnItsBoundary) {
  const auto box = reference::make_box({-1, -0.5, -0.25}, {1, 0.5, 0.25});
  const Eigen::Matrix3Xd samples = surface_samples(*box, 0.05);
  EXPECT_LE(box->signed_distance(samples, 1.0).cwiseAbs().maxCoeff(), 1e-3 * 0.05);
  const double area = 2.0 * (2.0 + 1.0 + 0.5);
  EXPECT_GT(static_cast<double>(samples.cols()), area / (0.05 * 0.05));
}

TEST(Hausdorff, RefusesWhatItCannotMeasure) {
  const auto solid = reference::make_ball({0, 0, 0}, 1.0);
  const Eigen::Matrix3Xd surface = surface_samples(*solid, 0.2);
  EXPECT_THROW((void)hausdorff_distance(Eigen::Matrix4Xd(4, 0), *solid, surface), InputError);
  EXPECT_THROW((void)hausdorff_distance(one_ball(0, 1), *solid, Eigen::Matrix3Xd(3, 0)),
               InputError);
  EXPECT_THROW((void)hausdorff_distance(one_ball(0, 1), *solid, surface, {.spacing = -1}),
               InputError);
  EXPECT_THROW((void)surface_samples(*solid, 0.0), InputError);
  EXPECT_THROW((void)surface_samples(shapes::cube(1.0), -1.0), InputError);
  EXPECT_THROW((void)surface_samples(shapes::cube(1.0), 1e-9), InputError);
}

}  // namespace
}  // namespace mortise
