// SPDX-License-Identifier: GPL-3.0-or-later
// Skeletal density against the full adaptive sum, and cases worked by hand.
#include "mortise/parts/skeletal_density.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "mortise/core/errors.hpp"
#include "parts/shapes.hpp"
#include "reference/skeletal_density.hpp"

namespace mortise {
namespace {

using Complex = std::complex<double>;
constexpr double kPi = std::numbers::pi;

double gaussian(double x, double sigma) {
  return std::exp(-0.5 * x * x / (sigma * sigma)) / (std::sqrt(2.0 * kPi) * sigma);
}

// In and around the mesh, every third point near the surface.
Eigen::Matrix3Xd probes(const TriangleMesh& mesh, int count) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> unit;
  const Eigen::AlignedBox3d box = MeshSolid(mesh).bounds();
  Eigen::Matrix3Xd points(3, count);
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d free =
        Eigen::Array3d(unit(random), unit(random), unit(random)) * 1.6 - 0.3;
    points.col(i) = box.min() + free.cwiseProduct(box.sizes());
    if (i % 3 != 0) continue;
    const auto t = static_cast<Eigen::Index>(unit(random) * static_cast<double>(mesh.size()));
    const Eigen::Vector3d on = 0.5 * mesh.vertices.col(mesh.triangles(0, t)) +
                               0.3 * mesh.vertices.col(mesh.triangles(1, t)) +
                               0.2 * mesh.vertices.col(mesh.triangles(2, t));
    points.col(i) = on + std::pow(10.0, -2.0 * unit(random)) * (points.col(i) - on);
  }
  return points;
}

struct DensityCase {
  std::string name;
  TriangleMesh mesh;
};

TEST(SkeletalDensity, IsTheFullSumToTheTolerance) {
  const std::vector<DensityCase> cases = {
      {"cube", shapes::cube()},
      {"plate", shapes::box({1.0, 0.1, 3.0})},
      {"ball", shapes::icosphere(1.0, 16)},
      {"coarse ball", shapes::icosphere(1.0, 3)},
      {"torus", shapes::torus(2.0, 0.7, 40, 24)},
      {"noisy", shapes::noisy_sphere(1.0, 5000, 0.3)},
      {"open", shapes::without_last(shapes::icosphere(1.0, 10), 400)}};
  for (const DensityCase& c : cases) {
    const MeshSolid solid(c.mesh);
    const Eigen::Matrix3Xd points = probes(c.mesh, 16);
    const Eigen::VectorXd xi =
        solid.signed_distance(points, std::numeric_limits<double>::infinity());
    for (const double sigma : {0.05, 0.5, 2.0}) {
      const Eigen::VectorXcd found =
          skeletal_density_at(solid, points, {.thickness = sigma, .penalty = 2.0});
      for (Eigen::Index i = 0; i < points.cols(); ++i) {
        const Complex expected =
            (xi[i] > 0.0 ? 1.0 : -2.0) *
            reference::skeletal_integral(c.mesh, points.col(i), xi[i], sigma, 1e-5);
        const double flat_wall = (xi[i] > 0.0 ? 1.0 : 2.0) * kPi / 2.0;
        EXPECT_LT(std::abs(found[i] - expected),
                  0.01 * std::max(std::abs(expected), 0.1 * flat_wall))
            << c.name << ", sigma " << sigma << ", point " << i << ", " << found[i] << " for "
            << expected;
      }
    }
  }
}

TEST(SkeletalDensity, InTheMiddleOfABallTheWholeSurfaceIsNearest) {
  // zeta = -r + ir everywhere: zeta^-2 = i / (2 r^2), dA_perp = dA, so 4 pi i / 2 g(0) times -p.
  const MeshSolid ball(shapes::icosphere(2.0, 20));
  for (const double sigma : {0.2, 0.5, 1.0}) {
    const Complex found = skeletal_density_at(
        ball, Eigen::Vector3d::Zero(), {.thickness = sigma, .exterior = 0.5, .penalty = 3.0})[0];
    const double expected = -0.5 * 3.0 * 2.0 * kPi * gaussian(0.0, sigma);
    EXPECT_NEAR(found.imag(), expected, 0.01 * std::abs(expected));
    EXPECT_NEAR(found.real(), 0.0, 0.01 * std::abs(expected));
  }
}

TEST(SkeletalDensity, OfAFlatWallDependsOnNeitherDistanceNorScale) {
  // With t = 1 / cos(angle) the solid angle within t is 2 pi (1 - 1 / t), and
  // zeta^-2 dA_perp = (s + it)^-2 t^2 d(solid angle): the integral is -+2 pi Int (s + it)^-2 g dt.
  const MeshSolid box(shapes::cube(1000.0));
  Eigen::Matrix3Xd points(3, 4);
  points.transpose() << 501.0, 1, 2, 500.2, 1, 2, 499.0, 1, 2, 499.9, 1, 2;
  for (const double sigma : {0.1, 0.5, 1.0}) {
    Complex integral = 0.0;
    const double step = 1e-3 * sigma;
    for (double t = 1.0 + 0.5 * step; t < 1.0 + 8.0 * sigma; t += step)
      integral += step * gaussian(t - 1.0, sigma) / (Complex(1.0, t) * Complex(1.0, t));
    const Eigen::VectorXcd found =
        skeletal_density_at(box, points, {.thickness = sigma, .penalty = 3.0});
    const Complex outside = -2.0 * kPi * integral, inside = 3.0 * -2.0 * kPi * std::conj(integral);
    for (int i = 0; i < 2; ++i) {
      EXPECT_LT(std::abs(found[i] - outside), 0.01 * std::abs(outside)) << sigma;
      EXPECT_LT(std::abs(found[i + 2] - inside), 0.01 * std::abs(inside)) << sigma;
    }
    EXPECT_GT(outside.imag(), 0.0);
    EXPECT_LT(inside.imag(), 0.0);
  }
}

TEST(SkeletalDensity, IsLargestOnTheSkeleton) {
  const MeshSolid cube(shapes::cube(2.0));
  Eigen::Matrix3Xd points(3, 4);  // centre, on a diagonal plane, beside it, near a face
  points.transpose() << 0, 0, 0, 0.6, 0.6, 0.1, 0.6, 0.3, 0.1, 0.9, 0.1, 0.05;
  const Eigen::VectorXcd found = skeletal_density_at(cube, points, {.thickness = 0.1});
  EXPECT_GT(std::abs(found[0]), 2.0 * std::abs(found[1]));
  EXPECT_GT(std::abs(found[1]), 1.5 * std::abs(found[2]));
  EXPECT_NEAR(std::abs(found[2]), std::abs(found[3]), 0.1 * std::abs(found[3]));
}

TEST(SkeletalDensity, RewardsInsideOnOutsideAndPunishesInsideOnInside) {
  const MeshSolid cube(shapes::cube(2.0));
  Eigen::Matrix3Xd points(3, 2);
  points.transpose() << 0.2, 0.1, 0.3, 1.5, 0.2, 0.1;
  const Eigen::VectorXcd rho = skeletal_density_at(cube, points);
  EXPECT_GT((rho[0] * rho[1]).real(), 0.0);
  EXPECT_LT((rho[0] * rho[0]).real(), 0.0);
  EXPECT_LT((rho[1] * rho[1]).real(), 0.0);
}

TEST(SkeletalDensity, MovesAndScalesWithThePart) {
  const TriangleMesh mesh = shapes::noisy_sphere(1.0, 3000, 0.3);
  const Eigen::Matrix3Xd points = probes(mesh, 50);
  const Eigen::VectorXcd found = skeletal_density_at(MeshSolid(mesh), points);
  const Eigen::Matrix3d R = Eigen::Quaterniond(0.1, -0.5, 0.7, 0.3).normalized().toRotationMatrix();
  const Eigen::Vector3d t(30.0, -4.0, 7.0);
  TriangleMesh moved = mesh;
  moved.vertices = ((10.0 * R) * mesh.vertices).colwise() + t;
  const Eigen::Matrix3Xd moved_points = ((10.0 * R) * points).colwise() + t;
  const Eigen::VectorXcd again = skeletal_density_at(MeshSolid(moved), moved_points);
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    // Each within the tolerance; the tree's boxes differ.
    EXPECT_LT(std::abs(found[i] - again[i]), 0.02 * std::max(std::abs(found[i]), 0.15)) << i;
}

TEST(SkeletalDensity, GridHoldsTheValuesAtItsNodesOnAnyThreads) {
  const MeshSolid solid(shapes::torus(2.0, 0.7, 24, 16));
  const GridNodes nodes = grid_around(solid.bounds(), 17, 0.4);
  const SkeletalDensity one = skeletal_density(solid, nodes, {.threads = 1});
  EXPECT_EQ(skeletal_density(solid, nodes, {.threads = 3}).values, one.values);
  EXPECT_EQ(skeletal_density(solid, distance_grid(solid, nodes)).values, one.values);
  for (int i = 0; i < nodes.size[0]; i += 3)
    for (int j = 0; j < nodes.size[1]; j += 2)
      for (int k = 0; k < nodes.size[2]; ++k) {
        const Complex there = skeletal_density_at(solid, nodes.node(i, j, k))[0];
        const Complex stored = one.values[static_cast<std::size_t>(nodes.index(i, j, k))];
        // The grid's distances are floats, which may tip a cluster over the limit of its moments.
        EXPECT_LT(std::abs(there - stored), 0.01 * std::max(std::abs(there), 0.15));
      }
}

TEST(SkeletalDensity, VanishesOnTheSurface) {
  EXPECT_EQ(skeletal_density_at(MeshSolid(shapes::cube(2.0)), Eigen::Vector3d(1.0, 0.25, 0.5))[0],
            Complex(0.0));
}

TEST(SkeletalDensity, RefusesWhatItCannotUse) {
  const MeshSolid solid(shapes::cube());
  const Eigen::Vector3d point(0.1, 0.2, 0.3);
  EXPECT_THROW((void)skeletal_density_at(solid, point, {.thickness = 0.0}), InputError);
  EXPECT_THROW((void)skeletal_density_at(solid, point, {.thickness = NAN}), InputError);
  EXPECT_THROW((void)skeletal_density_at(solid, point, {.tolerance = 1e-9}), InputError);
  EXPECT_THROW((void)skeletal_density_at(solid, point, {.penalty = NAN}), InputError);
  DistanceGrid grid = distance_grid(solid, grid_around(solid.bounds(), 3, 0.0));
  grid.values.pop_back();
  EXPECT_THROW((void)skeletal_density(solid, grid), InputError);
  EXPECT_THROW((void)skeletal_density(solid, GridNodes{}), InputError);
}

}  // namespace
}  // namespace mortise
