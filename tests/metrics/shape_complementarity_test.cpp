// SPDX-License-Identifier: GPL-3.0-or-later
// Sc on surfaces whose fit is known, and against its definition over all pairs of dots.
#include "mortise/metrics/shape_complementarity.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "metrics/bodies.hpp"
#include "mortise/core/errors.hpp"
#include "mortise/metrics/molecular_surface.hpp"

namespace mortise {
namespace {

// Balls on a square lattice in the plane z, n x n of them about the z axis.
Eigen::Matrix3Xd plate(int n, double step, double z) {
  Eigen::Matrix3Xd x(3, n * n);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      x.col(i * n + j) << step * (i - 0.5 * (n - 1)), step * (j - 0.5 * (n - 1)), z;
  return x;
}

// The definition, every dot against every other one.
Complementarity slow(const Eigen::Matrix3Xd& a, const Eigen::VectorXd& ra,
                     const Eigen::Matrix3Xd& b, const Eigen::VectorXd& rb,
                     const ComplementarityOptions& o) {
  const MolecularSurfaceOptions surface{.probe_radius = o.probe_radius, .density = o.density};
  struct Side {
    SurfaceDots dots;
    std::vector<Eigen::Index> kept;
  };
  const auto side = [&](const Eigen::Matrix3Xd& x, const Eigen::VectorXd& r,
                        const Eigen::Matrix3Xd& other, const Eigen::VectorXd& r_other) {
    Side out{molecular_surface(x, r, surface), {}};
    std::vector<char> buried;
    for (Eigen::Index i = 0; i < out.dots.size(); ++i) {
      const Eigen::Vector3d probe =
          out.dots.positions.col(i) + o.probe_radius * out.dots.normals.col(i);
      buried.push_back(
          ((other.colwise() - probe).colwise().norm().transpose() - r_other).minCoeff() <
          o.probe_radius);
    }
    for (Eigen::Index i = 0; i < out.dots.size(); ++i) {
      bool keep = buried[i] != 0;
      for (Eigen::Index k = 0; keep && k < out.dots.size(); ++k)
        keep = buried[k] != 0 ||
               (out.dots.positions.col(k) - out.dots.positions.col(i)).norm() >= o.trim;
      if (keep) out.kept.push_back(i);
    }
    return out;
  };
  const auto median = [&](const Side& from, const Side& to) {
    std::vector<std::pair<double, double>> values;
    double total = 0.0, sum = 0.0;
    for (const Eigen::Index i : from.kept) {
      double best = 1e30, value = 0.0;
      for (const Eigen::Index k : to.kept) {
        const double d = (from.dots.positions.col(i) - to.dots.positions.col(k)).squaredNorm();
        if (d >= best) continue;
        best = d;
        value = -from.dots.normals.col(i).dot(to.dots.normals.col(k)) * std::exp(-o.weight * d);
      }
      values.emplace_back(value, from.dots.areas[i]);
      total += from.dots.areas[i];
    }
    std::sort(values.begin(), values.end());
    for (const auto& [value, weight] : values)
      if ((sum += weight) >= 0.5 * total) return value;
    return std::nan("");
  };
  const Side first = side(a, ra, b, rb), second = side(b, rb, a, ra);
  Complementarity out;
  out.fixed_to_moving = median(first, second);
  out.moving_to_fixed = median(second, first);
  out.sc = 0.5 * (out.fixed_to_moving + out.moving_to_fixed);
  for (const Eigen::Index i : first.kept) out.area += 0.5 * first.dots.areas[i];
  for (const Eigen::Index i : second.kept) out.area += 0.5 * second.dots.areas[i];
  return out;
}

TEST(ShapeComplementarity, EqualsItsDefinition) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (const double density : {4.0, 15.0}) {
    Eigen::Matrix3Xd a = plate(5, 2.4, 0.0), b = plate(6, 2.1, 4.2);
    for (double& x : a.reshaped()) x += 0.5 * uniform(random);
    for (double& x : b.reshaped()) x += 0.5 * uniform(random);
    Eigen::VectorXd ra(25), rb(36);
    for (double& r : ra) r = 1.7 + 0.2 * uniform(random);
    for (double& r : rb) r = 1.7 + 0.2 * uniform(random);
    const ComplementarityOptions options{.density = density};
    const Complementarity fast = shape_complementarity(a, ra, b, rb, options);
    const Complementarity reference = slow(a, ra, b, rb, options);
    EXPECT_NEAR(fast.fixed_to_moving, reference.fixed_to_moving, 1e-6) << density;
    EXPECT_NEAR(fast.moving_to_fixed, reference.moving_to_fixed, 1e-6) << density;
    EXPECT_NEAR(fast.sc, reference.sc, 1e-6);
    EXPECT_NEAR(fast.area, reference.area, 1e-6 * reference.area);
    EXPECT_GT(fast.area, 20.0);
  }
}

TEST(ShapeComplementarity, FlatPlatesFitByTheirGap) {
  // Balls so close that the surfaces are planes but for ripples of r - sqrt(r^2 - step^2 / 2) =
  // 0.05: S = exp(-gap^2 / 2).
  const Eigen::VectorXd r = Eigen::VectorXd::Constant(23 * 23, 1.8);
  for (const double gap : {0.0, 0.8, 1.5}) {
    const Complementarity c =
        shape_complementarity(plate(23, 0.7, 0.0), r, plate(23, 0.7, 3.6 + gap), r, {.threads = 0});
    EXPECT_NEAR(c.sc, std::exp(-0.5 * gap * gap), 0.04) << gap;
    EXPECT_NEAR(c.gap, gap, 0.2) << gap;
    EXPECT_GT(c.area, 100.0);
  }
}

TEST(ShapeComplementarity, OneBallInTheHollowOfAnotherFitsBetterThanOnItsBack) {
  // A shell of small balls around the origin, open towards +z, and a ball inside it; then the same
  // ball pressed on the shell from outside.
  std::vector<Eigen::Vector3d> shell;
  const int count = 500;
  for (int i = 0; i < count; ++i) {
    const double z = 1.0 - (2.0 * i + 1.0) / count, ring = std::sqrt(1.0 - z * z);
    if (z < 0.2)
      shell.emplace_back(8.0 *
                         Eigen::Vector3d(ring * std::cos(2.4 * i), ring * std::sin(2.4 * i), z));
  }
  Eigen::Matrix3Xd x(3, static_cast<Eigen::Index>(shell.size()));
  for (std::size_t i = 0; i < shell.size(); ++i) x.col(static_cast<Eigen::Index>(i)) = shell[i];
  const Eigen::VectorXd r = Eigen::VectorXd::Constant(x.cols(), 1.5);
  const Eigen::VectorXd ball = Eigen::VectorXd::Constant(1, 6.0);
  const Complementarity inside = shape_complementarity(x, r, Eigen::Vector3d(0, 0, 0), ball);
  const Complementarity outside = shape_complementarity(x, r, Eigen::Vector3d(0, 0, -16.0), ball);
  EXPECT_GT(inside.sc, outside.sc + 0.1);
  EXPECT_GT(inside.area, 3.0 * outside.area);
}

TEST(ShapeComplementarity, NothingInCommonIsNoNumber) {
  const Eigen::VectorXd r = Eigen::VectorXd::Constant(9, 1.8);
  const Complementarity c = shape_complementarity(plate(3, 2, 0), r, plate(3, 2, 50), r);
  EXPECT_TRUE(std::isnan(c.sc));
  EXPECT_EQ(c.area, 0.0);
  EXPECT_TRUE(std::isnan(
      shape_complementarity(plate(3, 2, 0), r, Eigen::Matrix3Xd(3, 0), Eigen::VectorXd(0)).sc));
  for (const ComplementarityOptions& bad :
       {ComplementarityOptions{.probe_radius = 0.0}, ComplementarityOptions{.density = -1.0},
        ComplementarityOptions{.trim = std::nan("")}, ComplementarityOptions{.weight = 0.0},
        ComplementarityOptions{.threads = -1}})
    EXPECT_THROW((void)shape_complementarity(plate(3, 2, 0), r, plate(3, 2, 4), r, bad),
                 InputError);
}

TEST(ComplementarityRadii, ByNameAndElement) {
  using testing_bodies::make_atom;
  Molecule m;
  for (const auto& [name, residue] : std::vector<std::pair<const char*, const char*>>{{"CB", "ALA"},
                                                                                      {"CB", "LYS"},
                                                                                      {"CA", "ALA"},
                                                                                      {"CA", "GLY"},
                                                                                      {"C", "ALA"},
                                                                                      {"CZ", "PHE"},
                                                                                      {"N", "ALA"},
                                                                                      {"NZ", "LYS"},
                                                                                      {"O", "ALA"},
                                                                                      {"OG", "SER"},
                                                                                      {"SG", "CYS"},
                                                                                      {"CE", "MSE"},
                                                                                      {"P", "A"},
                                                                                      {"C1'", "A"}})
    m.atoms.push_back(make_atom(name, residue, "A", 1, {0, 0, 0}));
  const std::vector<double> expected{2.0,  1.925, 1.85, 1.925, 1.85, 1.85, 1.75,
                                     1.85, 1.6,   1.65, 2.0,   2.0,  2.1,  1.9};
  const Eigen::VectorXd radii = complementarity_radii(m);
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_EQ(radii[static_cast<Eigen::Index>(i)], expected[i]) << m.atoms[i].name;
}

}  // namespace
}  // namespace mortise
