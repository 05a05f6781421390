// SPDX-License-Identifier: GPL-3.0-or-later
// Each repair on a mesh broken on purpose; what cannot be repaired is refused with the place.
#include "mortise/parts/repair_mesh.hpp"

#include <gmock/gmock.h>

#include <limits>
#include <random>

#include "mortise/core/errors.hpp"
#include "mortise/parts/mesh_solid.hpp"
#include "parts/closed.hpp"
#include "parts/shapes.hpp"

namespace mortise {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// Every triangle with corners of its own, as in an STL file.
TriangleMesh scattered(const TriangleMesh& mesh) {
  TriangleMesh soup;
  soup.vertices.resize(3, 3 * mesh.size());
  soup.triangles.resize(3, mesh.size());
  for (Eigen::Index i = 0; i < 3 * mesh.size(); ++i) {
    soup.vertices.col(i) = mesh.vertices.col(mesh.triangles(i % 3, i / 3));
    soup.triangles(i % 3, i / 3) = static_cast<int>(i);
  }
  return soup;
}

TriangleMesh moved(TriangleMesh mesh, const Eigen::Vector3d& by) {
  mesh.vertices.colwise() += by;
  return mesh;
}

std::string error_of(const TriangleMesh& mesh, const RepairOptions& options = {}) {
  try {
    (void)repair_mesh(mesh, options);
  } catch (const InputError& e) {
    return e.what();
  }
  return "no error";
}

TEST(RepairMesh, LeavesAGoodMeshAlone) {
  const TriangleMesh ball = shapes::icosphere(2.0, 4);
  const RepairResult result = repair_mesh(ball);
  EXPECT_THAT(result.decisions, IsEmpty());
  EXPECT_TRUE(result.closed);
  EXPECT_EQ(result.mesh.triangles, ball.triangles);
  EXPECT_EQ(result.mesh.vertices, ball.vertices);
  EXPECT_NEAR(result.volume, shapes::volume(ball), 1e-12);
}

TEST(RepairMesh, JoinsCornersOfAScatteredMesh) {
  const TriangleMesh ball = shapes::icosphere(2.0, 4);
  const RepairResult result = repair_mesh(scattered(ball));
  EXPECT_THAT(result.decisions, IsEmpty());
  EXPECT_EQ(result.mesh.vertices.cols(), ball.vertices.cols());
  EXPECT_EQ(result.mesh.size(), ball.size());
}

TEST(RepairMesh, TurnsTrianglesTheSameWayAndOutward) {
  std::mt19937 random(3);
  TriangleMesh ball = shapes::icosphere(2.0, 4);
  const double volume = shapes::volume(ball);
  for (Eigen::Index i = 0; i < ball.size(); ++i) {
    if (random() % 3 == 0) std::swap(ball.triangles(0, i), ball.triangles(1, i));
  }
  EXPECT_NEAR(repair_mesh(ball).volume, volume, 1e-12);
  const RepairResult result = repair_mesh(shapes::inside_out(shapes::icosphere(2.0, 4)));
  EXPECT_NEAR(result.volume, volume, 1e-12);
  EXPECT_THAT(result.decisions, ElementsAre("turned 1 shell outward"));
}

TEST(RepairMesh, KeepsCavitiesAndTurnsSeveralShells) {
  const TriangleMesh outer = shapes::cube(4.0);
  const TriangleMesh cavity = shapes::inside_out(shapes::cube(2.0));
  const TriangleMesh beside = moved(shapes::cube(1.0), {9, 0, 0});
  const TriangleMesh good = shapes::join(shapes::join(outer, cavity), beside);
  EXPECT_NEAR(repair_mesh(good).volume, 64 - 8 + 1, 1e-12);
  // All inside out: the cavity is turned with the shell that holds it.
  EXPECT_NEAR(repair_mesh(shapes::inside_out(good)).volume, 64 - 8 + 1, 1e-12);
  // Only the piece beside: nothing else is touched.
  EXPECT_NEAR(
      repair_mesh(shapes::join(shapes::join(outer, cavity), shapes::inside_out(beside))).volume,
      64 - 8 + 1, 1e-12);
}

TEST(RepairMesh, DropsRepeatedAndFlatTriangles) {
  TriangleMesh ball = shapes::icosphere(2.0, 3);
  const double volume = shapes::volume(ball);
  const Eigen::Index count = ball.size();
  ball.triangles.conservativeResize(3, count + 3);
  ball.triangles.col(count) = ball.triangles.col(5);      // again
  ball.triangles.col(count + 1) << 4, 4, 9;               // a corner twice
  ball.triangles.col(count + 2) = ball.triangles.col(7);  // again
  const RepairResult result = repair_mesh(ball);
  EXPECT_THAT(result.decisions, ElementsAre("dropped 1 triangle with a repeated corner",
                                            "dropped 2 repeated triangles"));
  EXPECT_EQ(result.mesh.size(), count);
  EXPECT_NEAR(result.volume, volume, 1e-12);
}

TEST(RepairMesh, ClosesAJunctionInTheMiddleOfAnEdge) {
  // One edge of a cube has a further point on one side only: a triangle without area fills the gap
  // and gives way to a flip.
  TriangleMesh cube = shapes::cube(2.0);
  const Eigen::Vector3i t = cube.triangles.col(0);
  cube.vertices.conservativeResize(3, 9);
  cube.vertices.col(8) = 0.5 * (cube.vertices.col(t(0)) + cube.vertices.col(t(1)));
  cube.triangles.conservativeResize(3, 13);
  cube.triangles.col(0) << t(0), 8, t(2);
  cube.triangles.col(12) << 8, t(1), t(2);
  RepairOptions any_hole;
  any_hole.largest_hole = 2.0;
  const RepairResult result = repair_mesh(cube, any_hole);
  EXPECT_TRUE(result.closed);
  EXPECT_NEAR(result.volume, 8.0, 1e-12);
  EXPECT_EQ(result.mesh.size(), 14);
  for (const auto c : result.mesh.triangles.colwise()) {
    const Eigen::Vector3d a = result.mesh.vertices.col(c(0));
    const Eigen::Vector3d b = result.mesh.vertices.col(c(1)) - a;
    const Eigen::Vector3d d = result.mesh.vertices.col(c(2)) - a;
    EXPECT_GT(b.cross(d).norm(), 0.1);
  }
}

TEST(RepairMesh, MergesSeamsAndFillsSmallHoles) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> noise(-1e-7, 1e-7);
  const TriangleMesh ball = shapes::icosphere(2.0, 8);
  const double volume = shapes::volume(ball);
  TriangleMesh soup = scattered(ball);
  for (double& x : soup.vertices.reshaped()) x += noise(random);
  RepairResult result = repair_mesh(soup);
  EXPECT_TRUE(result.closed);
  EXPECT_EQ(result.mesh.vertices.cols(), ball.vertices.cols());
  EXPECT_NEAR(result.volume, volume, 1e-5);

  result = repair_mesh(shapes::without_last(ball, 3));
  EXPECT_TRUE(result.closed);
  EXPECT_EQ(result.decisions.size(), 1U);
  EXPECT_THAT(result.decisions.front(), HasSubstr("filled"));
  EXPECT_NEAR(result.volume, volume, 0.05);
  for (Eigen::Index n = 1; n <= 40; n += 3) {  // holes of any outline
    RepairOptions any_hole;
    any_hole.largest_hole = 1.0;
    result = repair_mesh(shapes::without_last(ball, n), any_hole);
    EXPECT_TRUE(result.closed) << n;
    EXPECT_TRUE(is_closed(result.mesh)) << n;
  }
}

TEST(RepairMesh, RefusesLargeHolesWithThePlaceOrAcceptsThem) {
  TriangleMesh open = shapes::cube(2.0);
  open = shapes::without_last(open, 6);  // three sides are missing: no flat opening
  EXPECT_THAT(error_of(open),
              HasSubstr("expected a closed surface, found 8 open edges, the first from ("));
  RepairOptions allow;
  allow.allow_open = true;
  const RepairResult result = repair_mesh(open, allow);
  EXPECT_FALSE(result.closed);
  EXPECT_THAT(result.decisions, ElementsAre("left 8 open edges: inside by winding number"));
}

TEST(RepairMesh, FillsFlatOpeningsOfAnySize) {
  const RepairResult result = repair_mesh(shapes::without_last(shapes::cube(2.0), 2));
  EXPECT_TRUE(result.closed);
  EXPECT_NEAR(result.volume, 8.0, 1e-12);
  EXPECT_THAT(result.decisions, ElementsAre(HasSubstr("filled 1 hole with 2 triangles")));
}

TEST(RepairMesh, TakesBothSidesOfAFaceForOne) {
  // As SketchUp exports them; a second part beside it is not doubled and keeps its triangles.
  TriangleMesh doubled = shapes::icosphere(1.0, 2);
  const Eigen::Index count = doubled.size();
  const double volume = shapes::volume(doubled);
  doubled.triangles.conservativeResize(3, 2 * count);
  for (Eigen::Index i = 0; i < count; ++i)
    doubled.triangles.col(count + i) = doubled.triangles.col(i).reverse();
  const RepairResult result =
      repair_mesh(shapes::join(scattered(doubled), moved(shapes::cube(1.0), {4.0, 0.0, 0.0})));
  EXPECT_TRUE(result.closed);
  EXPECT_EQ(result.mesh.size(), count + 12);
  EXPECT_NEAR(result.volume, volume + 1.0, 1e-9);
  EXPECT_THAT(result.decisions, testing::Contains("dropped the second sides of faces: " +
                                                  std::to_string(count) + " triangles"));
}

/// A box whose six sides are grids of different fineness, so that no edges meet; every second side
/// faces inward; each side is `share` of its size.
TriangleMesh loose_sides(double side, double share) {
  TriangleMesh mesh;
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector3i> triangles;
  for (int face = 0; face < 6; ++face) {
    const int axis = face / 2;
    const int n = 3 + 2 * face;
    const int first = static_cast<int>(points.size());
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j <= n; ++j) {
        Eigen::Vector3d p;
        p[axis] = (face % 2 == 0 ? -0.5 : 0.5) * side;
        p[(axis + 1) % 3] = share * side * (static_cast<double>(i) / n - 0.5);
        p[(axis + 2) % 3] = share * side * (static_cast<double>(j) / n - 0.5);
        points.push_back(p);
      }
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        const int a = first + i * (n + 1) + j;
        triangles.emplace_back(a, a + n + 1, a + n + 2);
        triangles.emplace_back(a, a + n + 2, a + 1);
      }
  }
  mesh.vertices.resize(3, static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i)
    mesh.vertices.col(static_cast<Eigen::Index>(i)) = points[i];
  mesh.triangles.resize(3, static_cast<Eigen::Index>(triangles.size()));
  for (std::size_t i = 0; i < triangles.size(); ++i)
    mesh.triangles.col(static_cast<Eigen::Index>(i)) = triangles[i];
  return mesh;
}

TEST(RepairMesh, TakesWhatLooseSidesEncloseForTheSolid) {
  // A wall inside, and a sheet in the open.
  TriangleMesh wall = loose_sides(2.0, 0.9);
  wall.triangles = wall.triangles.leftCols(2 * 3 * 3).eval();  // one side
  const TriangleMesh soup =
      shapes::join(shapes::join(loose_sides(2.0, 1.0), moved(wall, {1.3, 0.0, 0.0})),
                   moved(wall, {3.0, 0.0, 0.0}));
  for (const double share : {1.0, 0.99}) {
    const RepairResult result =
        repair_mesh(share == 1.0 ? soup : loose_sides(2.0, share), {.largest_hole = 0.01});
    EXPECT_FALSE(result.closed);
    EXPECT_EQ(result.deviation, 0.0);
    EXPECT_NEAR(result.volume, 8.0, share == 1.0 ? 1e-9 : 0.2);
    if (share == 1.0) {
      EXPECT_THAT(result.decisions,
                  testing::Contains("dropped 18 triangles of sheets without thickness"));
      EXPECT_THAT(result.decisions, testing::Contains("dropped 18 triangles inside the solid"));
    }
    const MeshSolid solid(result.mesh);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> place(-1.5, 1.5);
    Eigen::Matrix3Xd points(3, 400);
    for (double& x : points.reshaped()) x = place(random);
    const Eigen::VectorXd distance = solid.signed_distance(points, 10.0);
    for (Eigen::Index i = 0; i < points.cols(); ++i) {
      const double depth = 1.0 - points.col(i).cwiseAbs().maxCoeff();
      if (std::abs(depth) < 0.05) continue;
      EXPECT_EQ(distance[i]<0.0, depth> 0.0) << i;
    }
  }
}

TEST(RepairMesh, WrapsStripsThatEncloseABody) {
  // A ball of separate triangles, each of them shrunk: no winding number tells its inside surely.
  const TriangleMesh ball = shapes::icosphere(1.0, 24);
  TriangleMesh soup = scattered(ball);
  for (Eigen::Index i = 0; i < soup.size(); ++i) {
    auto corners = soup.vertices.middleCols<3>(3 * i);
    const Eigen::Vector3d middle = corners.rowwise().mean();
    corners = (0.7 * (corners.colwise() - middle)).colwise() + middle;
  }
  const RepairResult result = repair_mesh(soup, {.merge_tolerance = 0.0, .largest_hole = 0.0});
  EXPECT_TRUE(result.closed);
  EXPECT_TRUE(is_closed(result.mesh));
  EXPECT_GT(result.deviation, 0.0);
  EXPECT_THAT(result.decisions, testing::Contains(HasSubstr("wrapped the surface")));
  const Eigen::VectorXd radius = result.mesh.vertices.colwise().norm();
  EXPECT_LE(radius.maxCoeff(), 1.0 + 1.1 * result.deviation);
  EXPECT_GE(radius.minCoeff(), 0.97);
}

TEST(RepairMesh, ReportsCrossingTriangles) {
  const TriangleMesh two =
      shapes::join(shapes::cube(2.0), moved(shapes::cube(2.0), {1, 0.5, 0.25}));
  const RepairResult result = repair_mesh(two);
  EXPECT_TRUE(result.closed);
  EXPECT_GT(result.self_intersections, 0);
  EXPECT_THAT(result.decisions, testing::Contains(HasSubstr("crossing triangles")));
  RepairOptions blind;
  blind.find_self_intersections = false;
  EXPECT_EQ(repair_mesh(two, blind).self_intersections, 0);
  EXPECT_EQ(repair_mesh(shapes::noisy_sphere(1.0, 5000)).self_intersections, 0);
}

TEST(RepairMesh, KeepsSolidsThatTouchAlongAnEdge) {
  const TriangleMesh two = shapes::join(shapes::cube(2.0), moved(shapes::cube(2.0), {2, 2, 0}));
  const RepairResult result = repair_mesh(two);
  EXPECT_TRUE(result.closed);
  EXPECT_NEAR(result.volume, 16.0, 1e-12);
  EXPECT_THAT(result.decisions,
              testing::Contains("kept 1 edge at which more than two triangles meet"));
}

TEST(RepairMesh, RefusesWhatIsNoSolid) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(error_of({}), HasSubstr("expected triangles, found none"));
  TriangleMesh mesh = shapes::cube(2.0);
  mesh.vertices(1, 3) = nan;
  EXPECT_THAT(error_of(mesh), HasSubstr("vertex 3 is not finite"));
  mesh = shapes::cube(2.0);
  mesh.triangles(2, 4) = 8;
  EXPECT_THAT(error_of(mesh), HasSubstr("names vertex 8, expected 0 to 7"));
  mesh = shapes::cube(2.0);
  mesh.vertices.row(2).setZero();
  EXPECT_THAT(error_of(mesh), HasSubstr("nothing that encloses a volume"));
  mesh.vertices.setConstant(3.0);
  EXPECT_THAT(error_of(mesh), HasSubstr("in one point"));
  // A band with half a turn.
  TriangleMesh band;
  constexpr int kSteps = 12;
  band.vertices.resize(3, 2 * kSteps);
  band.triangles.resize(3, 2 * kSteps);
  for (int i = 0; i < kSteps; ++i) {
    const double a = 2 * std::numbers::pi * i / kSteps;
    for (int side = 0; side < 2; ++side) {
      const double w = (side - 0.5) * 0.8;
      band.vertices.col(2 * i + side) << (3 + w * std::cos(a / 2)) * std::cos(a),
          (3 + w * std::cos(a / 2)) * std::sin(a), w * std::sin(a / 2);
    }
    const bool last = i + 1 == kSteps;
    const int low = last ? 1 : 2 * i + 2;
    const int high = last ? 0 : 2 * i + 3;
    band.triangles.col(2 * i) << 2 * i, low, high;
    band.triangles.col(2 * i + 1) << 2 * i, high, 2 * i + 1;
  }
  EXPECT_THAT(error_of(band), HasSubstr("one side only"));
  RepairOptions bad;
  bad.merge_tolerance = nan;
  EXPECT_THAT(error_of(shapes::cube(1.0), bad), HasSubstr("merge_tolerance"));
}

}  // namespace
}  // namespace mortise
