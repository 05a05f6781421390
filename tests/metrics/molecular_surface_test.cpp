// SPDX-License-Identifier: GPL-3.0-or-later
// Surface dots against formulas for one to three balls and against the definition of the surface.
#include "mortise/metrics/molecular_surface.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "mortise/core/errors.hpp"
#include "mortise/molecules/radii.hpp"
#include "mortise/molecules/read_molecule.hpp"
#include "reference/slow_molecular_surface.hpp"

namespace mortise {
namespace {

double area(const SurfaceDots& dots, SurfacePatch patch) {
  double sum = 0.0;
  for (Eigen::Index i = 0; i < dots.size(); ++i)
    if (dots.patches[i] == patch) sum += dots.areas[i];
  return sum;
}

// By the divergence theorem; the origin does not matter if the surface is closed.
double volume(const SurfaceDots& dots) {
  return (dots.positions.cwiseProduct(dots.normals).colwise().sum() * dots.areas).value() / 3.0;
}

void expect_closed(const SurfaceDots& dots, double tolerance) {
  EXPECT_LT((dots.normals * dots.areas).norm(), tolerance * dots.areas.sum());
}

TEST(MolecularSurface, OneBall) {
  Eigen::Matrix3Xd x(3, 1);
  x << 1, 2, 3;
  const SurfaceDots dots = molecular_surface(x, Eigen::VectorXd::Constant(1, 1.9));
  EXPECT_NEAR(dots.areas.sum(), 4.0 * std::numbers::pi * 1.9 * 1.9, 1e-9);
  EXPECT_EQ(dots.size(), std::lround(15.0 * 4.0 * std::numbers::pi * 1.9 * 1.9));
  EXPECT_LT(((dots.positions - 1.9 * dots.normals).colwise() - x.col(0)).cwiseAbs().maxCoeff(),
            1e-6);
  expect_closed(dots, 1e-3);
}

// The profile of two balls and the saddle between them: the circle of probe centres has radius h
// and lies at a from the first centre; the probe spans the angles alpha and beta to both sides.
struct TwoBalls {
  double r1, r2, d, probe;
  double a = 0, h = 0, alpha = 0, beta = 0;
  TwoBalls(double first, double second, double distance, double probe_radius)
      : r1(first), r2(second), d(distance), probe(probe_radius) {
    const double R1 = r1 + probe, R2 = r2 + probe;
    a = (d * d + R1 * R1 - R2 * R2) / (2.0 * d);
    h = std::sqrt(R1 * R1 - a * a);
    alpha = std::atan2(a, h);
    beta = std::atan2(d - a, h);
  }
  [[nodiscard]] double contact() const {  // caps that the saddle leaves free
    return 2.0 * std::numbers::pi *
           (r1 * r1 * (1.0 + std::sin(alpha)) + r2 * r2 * (1.0 + std::sin(beta)));
  }
  // Integral of 2 pi (h - probe cos(angle)) probe d(angle), the part across the axis left out.
  [[nodiscard]] double saddle() const {
    const int steps = 200000;
    double sum = 0.0;
    for (int k = 0; k < steps; ++k) {
      const double angle = -alpha + (alpha + beta) * (k + 0.5) / steps;
      sum += std::max(0.0, h - probe * std::cos(angle));
    }
    return 2.0 * std::numbers::pi * probe * sum * (alpha + beta) / steps;
  }
};

TEST(MolecularSurface, TwoBallsNearFarAndUnequal) {
  for (const TwoBalls& c :
       {TwoBalls(1.9, 1.9, 2.0, 1.7), TwoBalls(1.9, 1.4, 1.5, 1.7), TwoBalls(1.9, 1.4, 5.0, 1.7),
        TwoBalls(1.5, 1.5, 6.2, 1.7), TwoBalls(2.0, 0.5, 2.2, 1.4), TwoBalls(3.0, 1.0, 2.2, 2.5)}) {
    Eigen::Matrix3Xd x = Eigen::Matrix3Xd::Zero(3, 2);
    x.col(1) = c.d * Eigen::Vector3d(1, 2, -2) / 3.0;
    const Eigen::Vector2d r(c.r1, c.r2);
    const SurfaceDots dots = molecular_surface(x, r, {.probe_radius = c.probe, .density = 60});
    EXPECT_NEAR(area(dots, SurfacePatch::kContact), c.contact(), 0.004 * c.contact()) << c.d;
    EXPECT_NEAR(area(dots, SurfacePatch::kToroidal), c.saddle(), 1e-5 * c.contact()) << c.d;
    EXPECT_EQ(area(dots, SurfacePatch::kConcave), 0.0);
    expect_closed(dots, 2e-3);
  }
}

TEST(MolecularSurface, BallsTooFarApartAndOneWithinAnother) {
  Eigen::Matrix3Xd x = Eigen::Matrix3Xd::Zero(3, 3);
  x(0, 1) = 7.0;
  x(1, 2) = 0.4;
  const SurfaceDots dots = molecular_surface(x, Eigen::Vector3d(1.8, 1.6, 1.0));
  EXPECT_NEAR(dots.areas.sum(), 4.0 * std::numbers::pi * (1.8 * 1.8 + 1.6 * 1.6), 1e-9);
  for (const std::int32_t atom : dots.atoms) EXPECT_NE(atom, 2);
}

// Angles of the spherical triangle from its sides; its area by the angles' excess over pi.
double triangle(double a, double b, double c) {
  const auto angle = [](double opposite, double s, double t) {
    return std::acos((std::cos(opposite) - std::cos(s) * std::cos(t)) /
                     (std::sin(s) * std::sin(t)));
  };
  return angle(a, b, c) + angle(b, c, a) + angle(c, a, b) - std::numbers::pi;
}

TEST(MolecularSurface, ThreeBallsHoldTwoTriangles) {
  // Equal balls r at the corners of a triangle; the probe rests above and below. Seen from it, two
  // centres stand at the angle 2 asin(side / (2 (r + probe))).
  const double r = 1.9, probe = 1.7;
  Eigen::Matrix3Xd x(3, 3);
  x << 0, 3.0, 1.0, 0, 0, 2.8, 0, 0, 0;
  const auto angle = [&](int i, int j) {
    return 2.0 * std::asin((x.col(i) - x.col(j)).norm() / (2.0 * (r + probe)));
  };
  const double expected = 2.0 * probe * probe * triangle(angle(0, 1), angle(1, 2), angle(2, 0));
  const SurfaceDots dots = molecular_surface(x, Eigen::Vector3d::Constant(r));
  EXPECT_NEAR(area(dots, SurfacePatch::kConcave), expected, 1e-5);
  expect_closed(dots, 5e-3);
}

TEST(MolecularSurface, FourBallsThatOneProbeTouches) {
  // A square: its probe position belongs to four triples, of which the shift leaves two.
  Eigen::Matrix3Xd x(3, 4);
  x << 0, 3, 3, 0, 0, 0, 3, 3, 0, 0, 0, 0;
  const SurfaceDots dots = molecular_surface(x, Eigen::Vector4d::Constant(1.9), {.density = 40});
  const test::SlowSolventExcluded slow(x, Eigen::Vector4d::Constant(1.9), 1.7);
  EXPECT_NEAR(volume(dots), slow.volume(0.17), 0.004 * volume(dots));
  expect_closed(dots, 2e-3);
}

TEST(MolecularSurface, RandomClustersAreTheSurfaceOfTheirDefinition) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (const int count : {3, 4, 6, 12, 25})
    for (const double crowding : {2.0, 3.2}) {
      Eigen::Matrix3Xd x(3, count);
      Eigen::VectorXd r(count);
      const double side = crowding * std::cbrt(count);
      for (int i = 0; i < count; ++i) {
        for (int k = 0; k < 3; ++k) x(k, i) = side * uniform(random);
        r[i] = 1.4 + 0.5 * uniform(random);
      }
      const double probe = 1.7;
      const SurfaceDots dots = molecular_surface(x, r, {.probe_radius = probe, .density = 30});
      const test::SlowSolventExcluded slow(x, r, probe);
      double worst_clearance = 0.0, wrong = 0.0, touch = 0.0;
      for (Eigen::Index i = 0; i < dots.size(); ++i) {
        const Eigen::Vector3d p = dots.positions.col(i), c = p + probe * dots.normals.col(i);
        worst_clearance = std::max(worst_clearance, std::abs(slow.clearance(c)));
        touch =
            std::max(touch, std::abs((c - x.col(dots.atoms[i])).norm() - r[dots.atoms[i]] - probe));
        // No other probe may cover the dot.
        if (slow.distance_to_free(p) < probe - 1e-5) wrong += dots.areas[i];
      }
      EXPECT_LT(worst_clearance, 1e-6) << count << ' ' << crowding;  // the shift of 1e-7
      EXPECT_LT(touch, 1e-6);
      EXPECT_LT(wrong, 2e-3 * dots.areas.sum()) << count << ' ' << crowding;
      expect_closed(dots, 4e-3);
      EXPECT_NEAR(volume(dots), slow.volume(0.3), 0.01 * volume(dots)) << count << ' ' << crowding;
    }
}

TEST(MolecularSurface, ProteinIsClosedAndThreadsChangeNothing) {
  const Molecule molecule =
      read_molecule({.path = std::string(MORTISE_SOURCE_DIR) + "/molecules/1hpv_receptor.pdb"})
          .molecule;
  const Eigen::Matrix3Xd x = atom_positions(molecule);
  const Eigen::VectorXd radii = atom_radii(molecule);
  const SurfaceDots dots = molecular_surface(x, radii);
  expect_closed(dots, 1e-3);
  EXPECT_TRUE(std::is_sorted(dots.atoms.begin(), dots.atoms.end()));
  EXPECT_NEAR(static_cast<double>(dots.size()) / dots.areas.sum(), 15.0, 2.0);
  const SurfaceDots parallel = molecular_surface(x, radii, {.threads = 3});
  EXPECT_EQ(dots.positions, parallel.positions);
  EXPECT_EQ(dots.areas, parallel.areas);
}

TEST(MolecularSurface, RefusesBadInput) {
  const Eigen::Matrix3Xd x = Eigen::Matrix3Xd::Zero(3, 2);
  const Eigen::Vector2d r(1, 1);
  EXPECT_EQ(molecular_surface(Eigen::Matrix3Xd(3, 0), Eigen::VectorXd(0)).size(), 0);
  EXPECT_THROW((void)molecular_surface(x, Eigen::VectorXd::Ones(1)), InputError);
  EXPECT_THROW((void)molecular_surface(x, -r), InputError);
  EXPECT_THROW((void)molecular_surface(x * std::nan(""), r), InputError);
  EXPECT_THROW((void)molecular_surface(x, r, {.probe_radius = 0.0}), InputError);
  EXPECT_THROW((void)molecular_surface(x, r, {.density = -1.0}), InputError);
  EXPECT_THROW((void)molecular_surface(x, r, {.threads = -1}), InputError);
}

}  // namespace
}  // namespace mortise
