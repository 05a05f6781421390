// SPDX-License-Identifier: GPL-3.0-or-later
// Distance and winding number of meshes against CGAL, the whole sum, and shapes known in closed
// form.
#include "mortise/parts/mesh_solid.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "mortise/core/errors.hpp"
#include "parts/shapes.hpp"
#include "reference/mesh_queries.hpp"

namespace mortise {
namespace {

constexpr double kEverywhere = std::numeric_limits<double>::infinity();

struct MeshCase {
  std::string name;
  TriangleMesh mesh;
};

TriangleMesh shifted(TriangleMesh mesh, const Eigen::Vector3d& by) {
  mesh.vertices.colwise() += by;
  return mesh;
}

std::vector<MeshCase> mesh_cases() {
  TriangleMesh slivers = shapes::box({1.0, 1e-3, 20.0});
  TriangleMesh degenerate = shapes::icosphere(1.0, 3);
  degenerate.triangles.conservativeResize(3, degenerate.size() + 2);
  const int a = degenerate.triangles(0, 0), b = degenerate.triangles(1, 0);
  degenerate.triangles.rightCols(2) << a, a, a, b, a, a;  // a corner and an edge of the first
  return {
      {"one triangle", shapes::without_last(shapes::cube(), 11)},
      {"cube", shapes::cube()},
      {"slivers", slivers},
      {"degenerate", degenerate},
      {"open", shapes::without_last(shapes::icosphere(2.0, 8), 100)},
      {"torus", shapes::torus(2.0, 0.7, 40, 24)},
      {"far from the origin", shifted(shapes::torus(2.0, 0.7, 40, 24), {300.0, -500.0, 1000.0})},
      {"noisy", shapes::noisy_sphere(1.0, 20000, 0.3)}};
}

// Points in a box twice as large as the mesh, on its surface and very near it.
Eigen::Matrix3Xd probes(const TriangleMesh& mesh, int count, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> unit;
  Eigen::AlignedBox3d box;
  for (Eigen::Index v = 0; v < mesh.vertices.cols(); ++v) box.extend(mesh.vertices.col(v));
  Eigen::Matrix3Xd points(3, count);
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d free =
        Eigen::Array3d(unit(random), unit(random), unit(random)) * 2.0 - 0.5;
    points.col(i) = box.min() + free.cwiseProduct(box.sizes());
    if (i % 4 == 0) continue;
    const auto t = static_cast<Eigen::Index>(unit(random) * static_cast<double>(mesh.size()));
    const double u = unit(random), v = unit(random) * (1.0 - u);
    const Eigen::Vector3d on = (1.0 - u - v) * mesh.vertices.col(mesh.triangles(0, t)) +
                               u * mesh.vertices.col(mesh.triangles(1, t)) +
                               v * mesh.vertices.col(mesh.triangles(2, t));
    points.col(i) =
        i % 4 == 1 ? on : on + std::pow(10.0, -3.0 * unit(random)) * (points.col(i) - on);
  }
  return points;
}

double size(const TriangleMesh& mesh) { return MeshSolid(mesh).bounds().diagonal().norm(); }

TEST(MeshSolid, DistanceIsThatOfCgal) {
  for (const MeshCase& c : mesh_cases()) {
    const MeshSolid solid(c.mesh);
    const Eigen::Matrix3Xd points = probes(c.mesh, 2000, 1);
    const Eigen::VectorXd expected = reference::distance(c.mesh, points);
    const Eigen::VectorXd found = solid.signed_distance(points, kEverywhere);
    const double scale = size(c.mesh) + points.cwiseAbs().maxCoeff();
    for (Eigen::Index i = 0; i < points.cols(); ++i)
      // 1e-6 relative; where the distance itself is rounding, that of the coordinates.
      ASSERT_NEAR(std::abs(found[i]), expected[i], 1e-6 * expected[i] + 1e-14 * scale)
          << c.name << ", point " << i;
  }
}

TEST(MeshSolid, NearestPointLiesOnItsTriangleAtTheDistance) {
  for (const MeshCase& c : mesh_cases()) {
    const MeshSolid solid(c.mesh);
    const Eigen::Matrix3Xd points = probes(c.mesh, 500, 2);
    const NearestPoints nearest = solid.nearest(points);
    const double scale = size(c.mesh) + points.cwiseAbs().maxCoeff();
    const Eigen::VectorXd distance = solid.signed_distance(points, kEverywhere);
    for (Eigen::Index i = 0; i < points.cols(); ++i) {
      EXPECT_EQ(nearest.distances[i], std::abs(distance[i])) << c.name;
      EXPECT_NEAR((nearest.points.col(i) - points.col(i)).norm(), nearest.distances[i],
                  1e-12 * scale)
          << c.name << ", point " << i;
      if (nearest.triangles[i] >= c.mesh.size() - 2 && c.name == "degenerate")
        continue;  // not for CGAL
      TriangleMesh own = c.mesh;
      own.triangles = c.mesh.triangles.col(nearest.triangles[i]).eval();
      EXPECT_LT(reference::distance(own, nearest.points.col(i))[0], 1e-12 * scale)
          << c.name << ", point " << i;
    }
  }
}

TEST(MeshSolid, WindingNumberIsTheWholeSum) {
  for (const MeshCase& c : mesh_cases()) {
    const Eigen::Matrix3Xd points = probes(c.mesh, 200, 3);
    const Eigen::VectorXd on = reference::distance(c.mesh, points);
    const double scale = size(c.mesh) + points.cwiseAbs().maxCoeff();
    for (const double reach : {1.5, 2.0, 4.0, kEverywhere}) {
      const Eigen::VectorXd found =
          MeshSolid(c.mesh, {.winding_reach = reach}).winding_number(points);
      // The expansion leaves out third order; the constants are twice the largest error seen.
      const double allowed = std::isinf(reach) ? 1e-7 : 0.1 / std::pow(reach, 3);
      for (Eigen::Index i = 0; i < points.cols(); ++i) {
        if (on[i] < 1e-10 * scale) continue;  // on the surface it jumps
        ASSERT_NEAR(found[i], reference::winding_number(c.mesh, points.col(i)), allowed)
            << c.name << ", reach " << reach << ", point " << i;
      }
    }
  }
}

TEST(MeshSolid, SignIsThatOfTheWholeSum) {
  for (const MeshCase& c : mesh_cases()) {
    const MeshSolid solid(c.mesh);
    const Eigen::Matrix3Xd points = probes(c.mesh, 400, 4);
    const Eigen::VectorXd found = solid.signed_distance(points, kEverywhere);
    const double scale = size(c.mesh) + points.cwiseAbs().maxCoeff();
    for (Eigen::Index i = 0; i < points.cols(); ++i) {
      const double winding = reference::winding_number(c.mesh, points.col(i));
      if (std::abs(found[i]) < 1e-10 * scale || std::abs(winding - 0.5) < 0.003) continue;
      ASSERT_EQ(found[i]<0.0, winding> 0.5) << c.name << ", point " << i << ", winding " << winding;
    }
  }
}

TEST(MeshSolid, KnowsACubeInClosedForm) {
  const MeshSolid solid(shapes::cube(2.0));
  EXPECT_TRUE(solid.closed());
  Eigen::Matrix3Xd points(3, 5);
  points.transpose() << 0, 0, 0, 0.5, 0, 0, 3, 0, 0, 2, 2, 2, 1, 0.3, 0.3;
  const Eigen::VectorXd d = solid.signed_distance(points, kEverywhere);
  EXPECT_NEAR(d[0], -1.0, 1e-15);
  EXPECT_NEAR(d[1], -0.5, 1e-15);
  EXPECT_NEAR(d[2], 2.0, 1e-15);
  EXPECT_NEAR(d[3], std::sqrt(3.0), 1e-15);
  EXPECT_EQ(std::abs(d[4]), 0.0);
  EXPECT_NEAR(solid.winding_number(points)[0], 1.0, 1e-9);
  EXPECT_NEAR(solid.winding_number(points)[2], 0.0, 1e-9);
  EXPECT_TRUE(solid.bounds().isApprox(
      Eigen::AlignedBox3d(Eigen::Vector3d::Constant(-1), Eigen::Vector3d::Constant(1))));
}

TEST(MeshSolid, OverlappingShellsUniteAndCavitiesAreOutside) {
  const TriangleMesh two = shapes::join(shapes::cube(2.0), shifted(shapes::cube(2.0), {1.0, 0, 0}));
  Eigen::Matrix3Xd points(3, 2);
  points.transpose() << 0.5, 0.2, 0.1, 0.1, 0, 0;
  const Eigen::VectorXd united = MeshSolid(two).signed_distance(points, kEverywhere);
  EXPECT_LT(united.maxCoeff(), 0.0);
  const TriangleMesh hollow =
      shapes::join(shapes::cube(2.0), shapes::inside_out(shapes::icosphere(0.3, 4)));
  const Eigen::VectorXd wall = MeshSolid(hollow).signed_distance(points, kEverywhere);
  EXPECT_LT(wall[0], 0.0);
  EXPECT_GT(wall[1], 0.0);
}

TEST(MeshSolid, ClosedMeansNoOpenEdge) {
  EXPECT_TRUE(MeshSolid(shapes::torus(2.0, 0.5, 12, 8)).closed());
  EXPECT_FALSE(MeshSolid(shapes::without_last(shapes::cube(), 1)).closed());
  TriangleMesh soup;  // every triangle with vertices of its own
  const TriangleMesh ball = shapes::icosphere(1.0, 3);
  soup.vertices.resize(3, 3 * ball.size());
  soup.triangles.resize(3, ball.size());
  for (Eigen::Index t = 0; t < ball.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      soup.vertices.col(3 * t + k) = ball.vertices.col(ball.triangles(k, t));
      soup.triangles(k, t) = static_cast<int>(3 * t + k);
    }
  EXPECT_TRUE(MeshSolid(soup).closed());
  soup.triangles.col(4).reverseInPlace();
  EXPECT_FALSE(MeshSolid(soup).closed());
}

TEST(MeshSolid, BandChangesNothingNearAndKeepsSizeAndSignBeyond) {
  const TriangleMesh mesh = shapes::noisy_sphere(1.0, 5000, 0.3);
  const MeshSolid solid(mesh);
  const Eigen::Matrix3Xd points = probes(mesh, 2000, 5);
  const Eigen::VectorXd exact = solid.signed_distance(points, kEverywhere);
  const double band = 0.2;
  const Eigen::VectorXd found = solid.signed_distance(points, band);
  int beyond = 0;
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    if (std::abs(exact[i]) < band) {
      EXPECT_EQ(found[i], exact[i]);
    } else {
      ++beyond;
      EXPECT_GE(std::abs(found[i]), band * (1.0 - 1e-15));
      EXPECT_EQ(found[i] < 0.0, exact[i] < 0.0);
    }
  }
  EXPECT_GT(beyond, 100);
}

TEST(MeshSolid, ThreadsChangeNothing) {
  const TriangleMesh mesh = shapes::torus(2.0, 0.7, 40, 24);
  const Eigen::Matrix3Xd points = probes(mesh, 3000, 6);
  EXPECT_EQ(MeshSolid(mesh, {.threads = 1}).signed_distance(points, kEverywhere),
            MeshSolid(mesh, {.threads = 3}).signed_distance(points, kEverywhere));
}

TEST(MeshSolid, RefusesWhatItCannotUse) {
  EXPECT_THROW(MeshSolid(TriangleMesh{}), InputError);
  TriangleMesh mesh = shapes::cube();
  mesh.triangles(1, 7) = 8;
  EXPECT_THROW(MeshSolid{mesh}, InputError);
  mesh = shapes::cube();
  mesh.vertices(2, 3) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(MeshSolid{mesh}, InputError);
  EXPECT_THROW(MeshSolid(shapes::cube(), {.winding_reach = 0.5}), InputError);
  const MeshSolid solid(shapes::cube());
  EXPECT_THROW((void)solid.signed_distance(Eigen::Matrix3Xd::Zero(3, 1), 0.0), InputError);
  EXPECT_THROW((void)solid.winding_number(Eigen::Matrix3Xd::Constant(3, 1, NAN)), InputError);
  EXPECT_THROW((void)solid.nearest(Eigen::Matrix3Xd::Constant(3, 1, INFINITY)), InputError);
  EXPECT_EQ(solid.signed_distance(Eigen::Matrix3Xd(3, 0), 1.0).size(), 0);
}

}  // namespace
}  // namespace mortise
