// SPDX-License-Identifier: GPL-3.0-or-later
// Solids with needles and plates: the balls hold them, and answers agree with exact mesh distances.
#include "mortise/collision/collision_body.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "collision/bodies.hpp"
#include "mortise/collision/collider.hpp"
#include "mortise/core/errors.hpp"
#include "mortise/parts/hausdorff.hpp"
#include "mortise/parts/mesh_solid.hpp"
#include "parts/shapes.hpp"

namespace mortise {
namespace {

using Eigen::Vector3d;

TriangleMesh turned(TriangleMesh mesh, const Eigen::Quaterniond& rotation, const Vector3d& shift) {
  mesh.vertices = (rotation.toRotationMatrix() * mesh.vertices).colwise() + shift;
  return mesh;
}

// A pyramid over a triangle of the given width: as thin as one likes.
TriangleMesh needle(const Vector3d& base, const Vector3d& tip, double width) {
  const Vector3d axis = (tip - base).normalized(), u = axis.unitOrthogonal(), v = axis.cross(u);
  TriangleMesh mesh;
  mesh.vertices.resize(3, 4);
  for (int i = 0; i < 3; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / 3.0;
    mesh.vertices.col(i) = base + width * (std::cos(angle) * u + std::sin(angle) * v);
  }
  mesh.vertices.col(3) = tip;
  mesh.triangles.resize(3, 4);
  mesh.triangles << 0, 0, 1, 2,  //
      2, 1, 2, 0,                //
      1, 3, 3, 3;
  return mesh;
}

Vector3d direction(std::mt19937_64& random) {
  return tests::random_rotation(random) * Vector3d::UnitX();
}

// A block, a plate through it and a needle out of it, all turned at random.
TriangleMesh random_solid(std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const auto thickness = [&] { return 0.4 * std::pow(0.02, uniform(random)); };
  TriangleMesh mesh = turned(shapes::box({0.8, 0.5, 0.6}), tests::random_rotation(random),
                             Vector3d(0.1, 0.2, -0.3));
  mesh = shapes::join(mesh, turned(shapes::box({1.2, 1.0, thickness()}),
                                   tests::random_rotation(random), Vector3d(0.0, 0.3, -0.2)));
  const Vector3d base(0.1, 0.2, -0.3);
  return shapes::join(mesh, needle(base, base + 1.2 * direction(random), 0.2 * thickness()));
}

double segment_distance(const Vector3d& p, const Vector3d& a, const Vector3d& q,
                        const Vector3d& b) {  // of p + s a and q + t b, s and t in [0, 1]
  const Vector3d r = p - q;
  const double aa = a.squaredNorm(), bb = b.squaredNorm(), ab = a.dot(b);
  const double det = aa * bb - ab * ab;
  double s = det > 0.0 ? std::clamp((ab * b.dot(r) - bb * a.dot(r)) / det, 0.0, 1.0) : 0.0;
  const double t = std::clamp((b.dot(r) + s * ab) / bb, 0.0, 1.0);
  s = std::clamp((t * ab - a.dot(r)) / aa, 0.0, 1.0);
  return (r + s * a - t * b).norm();
}

bool crosses(const Vector3d& p, const Vector3d& a, const Eigen::Matrix3d& corners) {
  Eigen::Matrix3d system;
  system << corners.col(1) - corners.col(0), corners.col(2) - corners.col(0), -a;
  if (std::abs(system.determinant()) < 1e-300) return false;
  const Vector3d x = system.inverse() * (p - corners.col(0));
  return x[0] >= 0.0 && x[1] >= 0.0 && x[0] + x[1] <= 1.0 && x[2] >= 0.0 && x[2] <= 1.0;
}

// Distance of two solids: 0 where they overlap. Every edge against every edge and triangle.
double solid_distance(const TriangleMesh& first, const TriangleMesh& second) {
  const MeshSolid a(first), b(second);
  const double inside = std::min(b.signed_distance(first.vertices, 1e9).minCoeff(),
                                 a.signed_distance(second.vertices, 1e9).minCoeff());
  if (inside <= 0.0) return 0.0;
  double least = inside;
  const auto corners = [](const TriangleMesh& mesh, Eigen::Index t) {
    Eigen::Matrix3d c;
    for (int i = 0; i < 3; ++i) c.col(i) = mesh.vertices.col(mesh.triangles(i, t));
    return c;
  };
  for (Eigen::Index s = 0; s < first.size(); ++s)
    for (Eigen::Index t = 0; t < second.size(); ++t) {
      const Eigen::Matrix3d x = corners(first, s), y = corners(second, t);
      for (int i = 0; i < 3; ++i) {
        const Vector3d e = x.col((i + 1) % 3) - x.col(i), f = y.col((i + 1) % 3) - y.col(i);
        if (crosses(x.col(i), e, y) || crosses(y.col(i), f, x)) return 0.0;
        for (int j = 0; j < 3; ++j)
          least = std::min(least,
                           segment_distance(x.col(i), e, y.col(j), y.col((j + 1) % 3) - y.col(j)));
      }
    }
  return least;
}

// How far a point is outside the balls.
double beyond(const Eigen::Matrix4Xd& balls, const Vector3d& p) {
  return ((balls.topRows<3>().colwise() - p).colwise().norm() - balls.row(3)).minCoeff();
}

TEST(CollisionBody, HoldsTheSolidAndLiesWithinTheMargin) {
  std::mt19937_64 random(5);
  int outside = 0;
  double margins = 0.0;
  for (int trial = 0; trial < 40; ++trial) {
    const TriangleMesh mesh = random_solid(random);
    const MeshSolid solid(mesh);
    const int grid = trial % 2 == 0 ? 8 : 17;
    const CollisionBody body = collision_body(solid, {.grid = grid, .threads = 1});
    const Eigen::Matrix4Xd& balls = body.balls.points;
    const double cell = solid.bounds().sizes().maxCoeff() / grid;
    margins = std::max(margins, body.margin / (0.5 * std::sqrt(3.0) * cell));
    // No sample of the surface, of the inside or of the vertices is outside the balls.
    double worst = -1.0;
    const Eigen::Matrix3Xd surface = surface_samples(mesh, 0.3 * cell);
    for (Eigen::Index i = 0; i < surface.cols(); ++i)
      worst = std::max(worst, beyond(balls, surface.col(i)));
    for (Eigen::Index i = 0; i < mesh.vertices.cols(); ++i)
      worst = std::max(worst, beyond(balls, mesh.vertices.col(i)));
    Eigen::Matrix3Xd inside(3, 2000);
    for (Eigen::Index i = 0; i < inside.cols(); ++i) inside.col(i) = solid.bounds().sample();
    const Eigen::VectorXd depth = solid.signed_distance(inside, 1e9);
    for (Eigen::Index i = 0; i < inside.cols(); ++i)
      if (depth[i] < 0.0) worst = std::max(worst, beyond(balls, inside.col(i)));
    EXPECT_LE(worst, 0.0) << trial;
    EXPECT_GT(worst, -body.margin) << trial;  // and the bound is not an idle one
    const Eigen::VectorXd distance = solid.signed_distance(balls.topRows<3>(), 1e9);
    for (Eigen::Index i = 0; i < balls.cols(); ++i)
      EXPECT_LE(balls(3, i) - body.margin, -distance[i]) << trial;
    outside += (distance.array() > 0.0).any() ? 1 : 0;
  }
  EXPECT_GT(outside, 5);    // balls about places outside were needed
  EXPECT_LT(margins, 3.5);  // half diagonals of a cell
  RecordProperty("largest_margin_in_half_diagonals", std::to_string(margins));
}

// The review's case: a ball of radius 1e-4 within the needle's tip was said to be apart.
TEST(CollisionBody, ATinyBallInANeedlesTipIsNeverApart) {
  std::mt19937_64 random(11);
  for (int trial = 0; trial < 40; ++trial) {
    const Vector3d tip = 1.2 * direction(random);
    const MeshSolid solid(shapes::join(shapes::cube(1.0), needle(Vector3d::Zero(), tip, 0.02)));
    const CollisionBody body = collision_body(solid, {.grid = 8, .threads = 1});
    const CollisionBody probe{{Eigen::Vector4d(0, 0, 0, 1e-4), Eigen::VectorXcd::Ones(1)}, 0.0};
    const Collider collider(body, probe);
    for (const double share : {0.6, 0.8, 0.9, 0.9999})
      EXPECT_NE(collider({Eigen::Quaterniond::Identity(), share * tip}).contact, Contact::kNo)
          << trial << " at " << share;
  }
}

TEST(Collider, SolidsAnswersAgreeWithExactDistances) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  int no = 0, yes = 0, band = 0, close = 0;
  for (int pair = 0; pair < 5; ++pair) {
    const TriangleMesh fixed = random_solid(random), moving = random_solid(random);
    const Collider collider(collision_body(MeshSolid(fixed), {.grid = 16 + 2 * pair, .threads = 1}),
                            collision_body(MeshSolid(moving), {.grid = 32 - pair, .threads = 1}),
                            {.tree_steps = 1000000});
    for (int i = 0; i < 30; ++i) {
      // Along a line out of the fixed body to where they cease to meet, then a little to a side.
      const Eigen::Quaterniond rotation = tests::random_rotation(random);
      const Vector3d out = direction(random);
      const auto distance = [&](double s) {
        return solid_distance(fixed, turned(moving, rotation, s * out));
      };
      double near = 0.0, far = 4.0;
      for (int step = 0; step < 8; ++step)
        (distance(0.5 * (near + far)) == 0.0 ? near : far) = 0.5 * (near + far);
      const double place = near + 2.0 * collider.tree_band() * uniform(random);
      const double apart = distance(place);
      const Collision answer = collider({rotation, place * out});
      if (answer.contact == Contact::kNo) {
        EXPECT_GT(apart, 0.0) << pair << ' ' << i;
        ++no;
      } else if (answer.contact == Contact::kYes) {
        EXPECT_EQ(apart, 0.0) << pair << ' ' << i;
        ++yes;
      } else {
        EXPECT_LE(apart, collider.tree_band()) << pair << ' ' << i;
        ++band;
      }
      close += apart < collider.tree_band() ? 1 : 0;
    }
  }
  EXPECT_GT(no, 10);
  EXPECT_GT(yes, 5);
  EXPECT_GT(band, 20);
  EXPECT_GT(close, 50);
}

// A plate thinner than a cell, turned: nodes and centres of balls lie outside it.
TEST(CollisionBody, TakesThinPlates) {
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.7, Vector3d(1, 2, 3).normalized()));
  for (const double thickness : {1.0, 0.3}) {
    const MeshSolid plate(turned(shapes::box({100.0, 80.0, thickness}), turn, {0, 0, 0}));
    const CollisionBody body = collision_body(plate, {.threads = 1});
    const double cell = plate.bounds().sizes().maxCoeff() / 64.0;
    EXPECT_LT(body.margin, 2.2 * 0.5 * std::sqrt(3.0) * cell);
    const Collider collider(body, body, {.tree_steps = 100000000});
    const auto at = [&](double s) {
      return collider({Eigen::Quaterniond::Identity(), turn * Vector3d(0, 0, s)}).contact;
    };
    EXPECT_NE(at(0.5 * thickness), Contact::kNo);
    EXPECT_EQ(at(thickness + 1.01 * collider.tree_band()), Contact::kNo);
  }
}

TEST(CollisionBody, TheDeviationWidensTheMarginOnBothSides) {
  const MeshSolid solid(shapes::icosphere(1.0, 6));
  const CollisionBody exact = collision_body(solid, {.grid = 16, .threads = 1}),
                      vague = collision_body(solid, {.grid = 16, .deviation = 0.01, .threads = 1});
  EXPECT_NEAR(vague.margin, exact.margin + 0.02, 1e-9);
  EXPECT_NEAR(vague.balls.points(3, 0), exact.balls.points(3, 0) + 0.01, 1e-9);
}

// The value is the common volume of the bodies as they are, not of the grown ones, but for the
// modes left out.
TEST(Collider, TheGapValueIsTheCommonVolume) {
  const CollisionBody cube = collision_body(MeshSolid(shapes::cube(1.0)), {.grid = 24});
  EXPECT_NEAR(cube.density.weights.real().sum(), 1.0, 1e-6);
  const Collider collider(cube, cube, {.modes = 2000, .with_gap = true});
  for (const double x : {0.0, 0.3, 0.5, 0.8}) {
    const Collision answer = collider({Eigen::Quaterniond::Identity(), {x, 0.2, 0.0}});
    EXPECT_NEAR(answer.gap.value, (1.0 - x) * 0.8, 0.08) << x;
    if (x > 0.1) {
      EXPECT_NEAR(answer.gap.translation_gradient[0], -0.8, 0.16) << x;
    }
  }
  EXPECT_NEAR(collider({Eigen::Quaterniond::Identity(), {1.6, 0.0, 0.0}}).gap.value, 0.0, 0.03);
}

TEST(CollisionBody, RefusesBadInput) {
  const MeshSolid cube(shapes::cube(1.0));
  EXPECT_THROW((void)collision_body(cube, {.grid = 1}), InputError);
  EXPECT_THROW((void)collision_body(cube, {.deviation = -1.0}), InputError);
  EXPECT_THROW((void)collision_body(cube, {.deviation = std::nan("")}), InputError);
}

}  // namespace
}  // namespace mortise
