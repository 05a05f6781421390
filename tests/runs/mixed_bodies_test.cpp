// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies of any kind with any: molecules, parts and balls in one run.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "mortise/core/errors.hpp"
#include "mortise/molecules/radii.hpp"
#include "mortise/parts/sample_surface.hpp"
#include "mortise/runs/body_forms.hpp"
#include "mortise/runs/run_kind.hpp"

namespace mortise {
namespace {

Body sample(const std::string& name) { return read_body(MORTISE_SOURCE_DIR "/" + name); }

TEST(MixedBodies, EachFileIsReadAsWhatItHolds) {
  EXPECT_NE(sample("molecules/1hpv_ligand.pdb").molecule(), nullptr);
  EXPECT_NE(sample("parts/tenon_rail.stl").part(), nullptr);
  EXPECT_EQ(sample("parts/tenon_rail.stl").record.kind, "part");
  EXPECT_THROW((void)sample("parts/tenon_rail.stl:A"), InputError);
  EXPECT_THROW((void)sample("README.md"), InputError);
}

// Atoms given as balls of the docking's own radius, and as the molecule without propensities or
// contacts, are one and the same thing to the search.
TEST(MixedBodies, BallsDockAsTheMoleculeTheyAre) {
  const Body fixed = sample("molecules/1hpv_receptor.pdb");
  const Body moving = sample("molecules/1hpv_ligand.pdb");
  const auto balls = [](const Body& body) {
    return Body(to_knots(*body.molecule(), {.radius = 1.8, .propensity = 0.0}));
  };
  DockOptions options;
  options.rotations = 60;
  options.propensity = 0.0;
  options.rescore = false;
  options.poses = 20;
  const mortise::Run molecules = dock(fixed, moving, options);
  const mortise::Run mixed = dock(balls(fixed), moving, options);
  const mortise::Run both = dock(balls(fixed), balls(moving), options);
  ASSERT_EQ(molecules.poses.poses.size(), mixed.poses.poses.size());
  for (std::size_t i = 0; i < molecules.poses.poses.size(); ++i) {
    EXPECT_EQ(molecules.poses.poses[i].score, mixed.poses.poses[i].score);
    EXPECT_EQ(molecules.poses.poses[i].score, both.poses.poses[i].score);
  }
  EXPECT_EQ(mixed.fixed.kind, "balls");
  EXPECT_EQ(mixed.moving.kind, "molecule");
}

// A ball-shaped pore in a block of balls, and a molecule's worth of atoms that fills it.
TEST(MixedBodies, AMoleculeFindsThePoreOfAMesh) {
  const Body part = sample("parts/ball_cup_exact.stl");
  const Eigen::AlignedBox3d box = part.part()->solid->bounds();
  EXPECT_GT(body_knots(part, {}, 24).size(), 10);
  DockOptions options;
  options.rotations = 1;
  options.ball_grid = 24;
  options.rescore = false;
  options.poses = 5;
  // One atom-like ball half as large as the part's hollow is wide: any place will do but inside.
  Knots ball{Eigen::Vector4d(0.0, 0.0, 0.0, 1.8), Eigen::VectorXcd::Ones(1)};
  const mortise::Run run = dock(part, Body(ball), options);
  ASSERT_FALSE(run.poses.poses.empty());
  const Eigen::Vector3d at = run.poses.poses.front().moving_in_fixed.translation;
  EXPECT_LT(box.exteriorDistance(at), 1.8 + options.double_skin.offset + options.search.spacing);
  EXPECT_GT(part.part()->solid->signed_distance(at, 10.0)[0], -2.0);
}

TEST(MixedBodies, BallsAreAPartWithTheSurfaceOfTheirUnion) {
  Knots two{Eigen::Matrix4Xd(4, 2), Eigen::VectorXcd::Ones(2)};
  two.points << 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 1.0;
  const Part part = body_part(two);
  const double area = surface_area(part.mesh);
  // Two unit spheres at distance 1, less the caps of height 1/2 that each has in the other.
  EXPECT_NEAR(area, 2.0 * (4.0 - 2.0 * 0.5) * M_PI, 0.05 * 6.0 * M_PI);
  EXPECT_NEAR(part.solid->signed_distance(Eigen::Vector3d(-2.0, 0.0, 0.0), 1e9)[0], 1.0, 1e-12);
}

// The sample ball, as the mesh it is stored as and as the one ball that it is.
TEST(MixedBodiesSlow, ABallMatesAsItsMeshDoes) {
  const Body cup = sample("parts/ball_cup_exact.stl");
  const Body mesh = sample("parts/ball.stl");
  const Eigen::AlignedBox3d box = mesh.part()->solid->bounds();
  Eigen::Vector4d ball;
  ball << box.center(), 0.5 * box.sizes().maxCoeff();
  MateOptions options;
  options.rotations = 60;
  options.turns = 6;  // turns about a ball's axes are all alike
  options.spacing = 0.03;
  options.skin = 0.045;
  options.distance_spacing = 0.02;
  options.samples = 1000;
  options.polished = 15;
  options.poses = 10;
  options.check = 1;
  options.random_start = 3;
  const auto place = [&](const mortise::Run& run) -> Eigen::Vector3d {
    return run.poses.poses.at(0).moving_in_fixed * Eigen::Vector3d(ball.head<3>());
  };
  const mortise::Run of_mesh = mate(cup, mesh, options);
  const mortise::Run of_ball = mate(cup, Knots{ball, Eigen::VectorXcd::Ones(1)}, options);
  EXPECT_LT((place(of_mesh) - place(of_ball)).norm(), 0.02 * 2.0 * ball[3]);
  // The cup's facets are chords: a true ball touches them less than its own mesh does.
  EXPECT_NEAR(of_mesh.poses.poses[0].score, of_ball.poses.poses[0].score,
              0.3 * of_mesh.poses.poses[0].score);
  EXPECT_EQ(of_ball.moving.kind, "balls");
  EXPECT_GT(of_ball.metrics.front().values.front(), 0.0);  // contact_area
}

}  // namespace
}  // namespace mortise
