// SPDX-License-Identifier: GPL-3.0-or-later
// Buried balls merged: by hand on a lattice, what is kept, and what must not happen.
#include "mortise/molecules/merge_buried.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <set>
#include <tuple>

#include "mortise/core/errors.hpp"
#include "mortise/molecules/surface.hpp"
#include "mortise/molecules/to_knots.hpp"

namespace mortise {
namespace {

// A cube of (2 n + 1)^3 balls, 2 apart.
Knots lattice(int n, double radius = 1.8) {
  Knots knots;
  const int side = 2 * n + 1;
  knots.points.resize(4, side * side * side);
  knots.weights = Eigen::VectorXcd::Ones(knots.points.cols());
  Eigen::Index at = 0;
  for (int i = -n; i <= n; ++i)
    for (int j = -n; j <= n; ++j)
      for (int k = -n; k <= n; ++k, ++at) {
        knots.points.col(at) << 2.0 * i, 2.0 * j, 2.0 * k, radius;
        knots.weights[at] = 1.0 + 0.01 * static_cast<double>(at % 7);
      }
  return knots;
}

double skin_integral(const Knots& knots, double offset) {
  return (knots.weights.real().array() * (knots.points.row(3).transpose().array() + offset).pow(3))
      .sum();
}

using Place = std::tuple<double, double, double, double>;
std::set<Place> places(const Knots& knots) {
  std::set<Place> set;
  for (Eigen::Index i = 0; i < knots.size(); ++i)
    set.insert({knots.points(0, i), knots.points(1, i), knots.points(2, i), knots.points(3, i)});
  return set;
}

TEST(MergeBuried, CubeByHand) {
  // 5^3 balls: only the middle one has 4 others (its 6 neighbours) within a ball of 3.9: 2 + 1.8.
  // Its depth below the faces, where probes touch at 4 + 3.2 from the middle, leaves it 5.8; the
  // neighbours have 3.8, which holds nothing but themselves beside.
  const Knots cube = lattice(2);
  const Knots merged = merge_buried(cube, {.largest = 3.9});
  ASSERT_EQ(merged.size(), 125 - 7 + 1);
  const Eigen::Index last = merged.size() - 1;
  EXPECT_EQ(merged.points.col(last), Eigen::Vector4d(0, 0, 0, 3.9));
  double weight = 0.0;  // of the seven, (3.2 / 5.3)^3 each
  for (Eigen::Index i = 0; i < cube.size(); ++i)
    if (cube.points.col(i).head<3>().norm() < 2.1) weight += cube.weights[i].real();
  EXPECT_NEAR(merged.weights[last].real(), weight * std::pow(3.2 / 5.3, 3), 1e-12);
  // What is left stays in order.
  const std::set<Place> before = places(cube);
  for (Eigen::Index i = 0; i + 1 < merged.size(); ++i) {
    const Eigen::Vector4d p = merged.points.col(i);
    EXPECT_TRUE(before.contains({p[0], p[1], p[2], p[3]}));
    EXPECT_GT(p.head<3>().norm(), 2.1);
  }
}

TEST(MergeBuried, KeepsSurfaceAndIntegralAndStaysInside) {
  const Knots cube = lattice(5);
  for (const double largest : {4.0, 5.0, 7.0}) {
    const Knots merged = merge_buried(cube, {.largest = largest, .offset = 1.1});
    EXPECT_LT(merged.size(), 0.85 * static_cast<double>(cube.size())) << largest;
    // Sums of a thousand terms in another order.
    EXPECT_NEAR(skin_integral(merged, 1.1) / skin_integral(cube, 1.1), 1.0, 1e-12) << largest;
    // Nothing that a probe touches has gone, and no merged ball comes up to the surface.
    const Eigen::VectorXd area =
        accessible_areas(cube.points.topRows<3>(), cube.points.row(3), {.points_per_atom = 200});
    const std::set<Place> left = places(merged);
    for (Eigen::Index i = 0; i < cube.size(); ++i) {
      if (area[i] <= 0.0) continue;
      const Eigen::Vector4d p = cube.points.col(i);
      EXPECT_TRUE(left.contains({p[0], p[1], p[2], p[3]})) << largest << " " << i;
    }
    for (Eigen::Index i = 0; i < merged.size(); ++i) {
      EXPECT_LE(merged.points(3, i), largest);
      // Between the lattice's balls a probe sinks in: faces lie within 10 + 1.8.
      EXPECT_LE(merged.points.col(i).head<3>().lpNorm<Eigen::Infinity>() + merged.points(3, i),
                11.8 + 1e-9);
    }
  }
}

TEST(MergeBuried, LeavesWhatHasNoInside) {
  const Knots few = lattice(1);
  const Knots same = merge_buried(few);
  EXPECT_EQ(same.points, few.points);
  EXPECT_EQ(same.weights, few.weights);
}

TEST(MergeBuried, TurnsWithTheBody) {
  const Knots cube = lattice(3);
  Knots moved = cube;
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  moved.points.topRows<3>() =
      ((turn * cube.points.topRows<3>()).colwise() + Eigen::Vector3d(5, -3, 40)).eval();
  const Knots a = merge_buried(cube, {.largest = 3.9}), b = merge_buried(moved, {.largest = 3.9});
  // The surface's sample points do not turn with it; the cap on the radius decides here.
  ASSERT_EQ(a.size(), b.size());
  EXPECT_NEAR(skin_integral(a, 1.4), skin_integral(b, 1.4), 1e-9 * skin_integral(a, 1.4));
}

TEST(MergeBuried, RefusesBadInput) {
  EXPECT_THROW((void)merge_buried({}), InputError);
  const Knots cube = lattice(1);
  for (const double bad : {-1.0, std::nan("")}) {
    EXPECT_THROW((void)merge_buried(cube, {.largest = bad}), InputError);
    EXPECT_THROW((void)merge_buried(cube, {.probe = bad}), InputError);
    EXPECT_THROW((void)merge_buried(cube, {.offset = bad}), InputError);
  }
  EXPECT_THROW((void)merge_buried(cube, {.largest = 0.0}), InputError);
  EXPECT_THROW((void)merge_buried(cube, {.least = 1}), InputError);
}

}  // namespace
}  // namespace mortise
