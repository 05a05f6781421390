// SPDX-License-Identifier: GPL-3.0-or-later
// Accessible areas against formulas for a few spheres and against exact arcs on latitudes.
#include "mortise/molecules/surface.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <limits>
#include <numbers>
#include <random>

#include "mortise/core/errors.hpp"
#include "mortise/molecules/radii.hpp"
#include "mortise/molecules/read_molecule.hpp"
#include "reference/sphere_areas.hpp"

namespace mortise {
namespace {

constexpr double kPi = std::numbers::pi;

double sphere(double radius) { return 4.0 * kPi * radius * radius; }

/// Area that a sphere of radius b at distance d cuts from one of radius a.
double cap(double a, double b, double d) {
  return 2.0 * kPi * a * (a - (a * a + d * d - b * b) / (2.0 * d));
}

// N points in golden order hit a smooth cap's share of the sphere to about 1 / N.
SurfaceOptions fine(double probe) { return {.probe_radius = probe, .points_per_atom = 2000}; }

TEST(AccessibleAreas, OneTwoAndThreeSpheresMatchTheFormulas) {
  Eigen::Matrix3Xd x(3, 3);
  x << 0, 2.5, 0, 0, 0, -3.1, 0, 0, 0;
  const Eigen::Vector3d r(1.2, 1.5, 0.9);
  const double a = 1.2 + 1.0, b = 1.5 + 1.0, c = 0.9 + 1.0;
  EXPECT_NEAR(accessible_areas(x.leftCols(1), r.head(1), fine(1.0))[0], sphere(a), 1e-9);
  const Eigen::VectorXd two = accessible_areas(x.leftCols(2), r.head(2), fine(1.0));
  EXPECT_NEAR(two[0], sphere(a) - cap(a, b, 2.5), 0.005 * sphere(a));
  EXPECT_NEAR(two[1], sphere(b) - cap(b, a, 2.5), 0.005 * sphere(b));
  // Without a probe the caps of the first sphere (from +x and -y) stay apart.
  Eigen::Matrix3Xd y = x;
  y.col(2) *= 0.6;
  const Eigen::VectorXd three = accessible_areas(y, r, fine(0.0));
  EXPECT_NEAR(three[0], sphere(1.2) - cap(1.2, 1.5, 2.5) - cap(1.2, 0.9, 1.86),
              0.005 * sphere(1.2));
  EXPECT_NEAR(three[1], sphere(1.5) - cap(1.5, 1.2, 2.5), 0.005 * sphere(1.5));
  EXPECT_NEAR(three[2], sphere(0.9) - cap(0.9, 1.2, 1.86), 0.005 * sphere(0.9));
  EXPECT_LT(c, 3.1);
}

TEST(AccessibleAreas, HiddenEqualAndFarSpheres) {
  Eigen::Matrix3Xd x = Eigen::Matrix3Xd::Zero(3, 5);
  x.col(1).x() = 0.1;                 // inside the first
  x.col(3) << 9000.0, -8000.0, 7000;  // alone, far away
  x.col(4) = x.col(3);                // the same ball once more
  Eigen::VectorXd r(5);
  r << 3.0, 1.0, 0.0, 2.0, 2.0;
  const Eigen::VectorXd areas = accessible_areas(x, r, fine(0.0));
  EXPECT_NEAR(areas[0], sphere(3.0), 1e-9);
  EXPECT_EQ(areas[1], 0.0);
  EXPECT_EQ(areas[2], 0.0);
  EXPECT_NEAR(areas[3] + areas[4], sphere(2.0), 1e-9);
  EXPECT_EQ(accessible_areas(Eigen::Matrix3Xd(3, 0), Eigen::VectorXd(0)).size(), 0);
}

TEST(AccessibleAreas, RandomClustersMatchLatitudes) {
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> place(0.0, 1.0);
  for (const int count : {2, 5, 20, 80}) {
    Eigen::Matrix3Xd x(3, count);
    Eigen::VectorXd r(count);
    const double side = 3.0 * std::cbrt(count);
    for (int i = 0; i < count; ++i) {
      x.col(i) << side * place(generator), side * place(generator), side * place(generator);
      r[i] = 1.0 + place(generator);
    }
    const Eigen::VectorXd reference =
        test::sphere_areas_by_latitudes(x, (r.array() + 1.4).matrix(), 2000);
    const Eigen::VectorXd areas = accessible_areas(x, r, fine(1.4));
    for (int i = 0; i < count; ++i)
      EXPECT_NEAR(areas[i], reference[i], 0.005 * sphere(r[i] + 1.4)) << count;
    EXPECT_NEAR(areas.sum(), reference.sum(), 0.003 * reference.sum()) << count;
  }
}

class SampleSurface : public testing::Test {
 protected:
  const Molecule molecule_ =
      read_molecule({.path = std::string(MORTISE_SOURCE_DIR) + "/molecules/1hpv_receptor.pdb"})
          .molecule;
};

TEST_F(SampleSurface, ProteinMatchesLatitudesWithDefaultOptions) {
  const Eigen::VectorXd radii = atom_radii(molecule_);
  const Eigen::VectorXd reference = test::sphere_areas_by_latitudes(
      atom_positions(molecule_), (radii.array() + 1.4).matrix(), 400);
  const Eigen::VectorXd areas = accessible_areas(molecule_);
  EXPECT_NEAR(areas.sum(), reference.sum(), 0.002 * reference.sum());
  double worst = 0.0, square = 0.0;
  for (Eigen::Index i = 0; i < areas.size(); ++i) {
    const double error = (areas[i] - reference[i]) / sphere(radii[i] + 1.4);
    worst = std::max(worst, std::abs(error));
    square += error * error;
  }
  EXPECT_LT(worst, 0.01);  // of the atom's whole sphere: ten of its 1000 points
  EXPECT_LT(std::sqrt(square / static_cast<double>(areas.size())), 0.003);
  // Residue by residue, where there is area to speak of.
  for (const ResidueRange& range : residues(molecule_)) {
    const auto first = static_cast<Eigen::Index>(range.first),
               n = static_cast<Eigen::Index>(range.last) - first;
    const double expected = reference.segment(first, n).sum();
    if (expected < 50.0) continue;
    EXPECT_NEAR(areas.segment(first, n).sum(), expected, 0.02 * expected);
  }
}

TEST_F(SampleSurface, TurningThreadsAndOrderChangeLittleOrNothing) {
  const Eigen::Matrix3Xd x = atom_positions(molecule_);
  const Eigen::VectorXd radii = atom_radii(molecule_);
  const Eigen::VectorXd areas = accessible_areas(x, radii);
  EXPECT_EQ(areas, accessible_areas(x, radii, {.threads = 2}));
  EXPECT_EQ(areas.reverse(), accessible_areas(x.rowwise().reverse(), radii.reverse()));
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(1.0, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  EXPECT_NEAR(areas.sum(), accessible_areas(turn * x, radii).sum(), 0.01 * areas.sum());
}

TEST_F(SampleSurface, AccessiblePointsAreThoseTheAreasCount) {
  const Eigen::Matrix3Xd x = atom_positions(molecule_);
  const Eigen::VectorXd radii = atom_radii(molecule_);
  const SurfaceOptions options{.probe_radius = 1.4, .points_per_atom = 100};
  const AccessiblePoints points = accessible_points(x, radii, options);
  const Eigen::VectorXd areas = accessible_areas(x, radii, options);
  ASSERT_EQ(points.first.size(), static_cast<std::size_t>(radii.size()) + 1);
  ASSERT_EQ(points.first.back(), points.positions.cols());
  for (Eigen::Index i = 0; i < radii.size(); ++i) {
    const Eigen::Index count = points.first[i + 1] - points.first[i];
    EXPECT_NEAR(static_cast<double>(count) * points.areas[i], areas[i], 1e-9 * (1.0 + areas[i]));
    for (Eigen::Index p = points.first[i]; p < points.first[i + 1]; ++p) {
      const Eigen::VectorXd distances =
          (x.colwise() - points.positions.col(p)).colwise().norm().transpose();
      EXPECT_NEAR(distances[i], radii[i] + 1.4, 1e-9);
      EXPECT_GT((distances - radii).minCoeff(), 1.4 - 1e-9);
    }
  }
  EXPECT_EQ(accessible_points(Eigen::Matrix3Xd(3, 0), Eigen::VectorXd(0)).positions.cols(), 0);
}

TEST(AccessibleAreas, RefusesBadInput) {
  const Eigen::Matrix3Xd x = Eigen::Matrix3Xd::Zero(3, 2);
  const Eigen::Vector2d r(1, 1);
  EXPECT_THROW((void)accessible_areas(x, Eigen::VectorXd::Ones(1)), InputError);
  EXPECT_THROW((void)accessible_areas(x, -r), InputError);
  EXPECT_THROW((void)accessible_areas(x * std::numeric_limits<double>::quiet_NaN(), r), InputError);
  EXPECT_THROW((void)accessible_areas(x, r, {.probe_radius = -1}), InputError);
  EXPECT_THROW((void)accessible_areas(x, r, {.points_per_atom = 0}), InputError);
  EXPECT_THROW((void)accessible_areas(x, r, {.threads = -1}), InputError);
}

}  // namespace
}  // namespace mortise
