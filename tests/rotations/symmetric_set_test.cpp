// SPDX-License-Identifier: GPL-3.0-or-later
// The optimiser's objective: its radius against the library's, its gradient against finite
// differences.
#include "symmetric_set.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "helpers/random_motions.hpp"
#include "mortise/rotations/coverage.hpp"
#include "reference/rotations_reference.hpp"
#include "rotations/groups.hpp"

namespace mortise {
namespace {

// Representatives that make no hopeless set: super-Fibonacci would do, but random ones jostled
// apart show more.
Rotations spread_representatives(SymmetricSet& set, std::size_t count, unsigned seed) {
  std::mt19937_64 random(seed);
  Rotations p(count);
  for (Eigen::Quaterniond& q : p) q = tests::random_rotation(random);
  for (int step = 0; step < 60; ++step) {
    const Eigen::VectorXd gradient = set.evaluate(p, 8.0).gradient;
    const double scale = 0.1 * set.ball() / gradient.lpNorm<Eigen::Infinity>();
    for (std::size_t i = 0; i < count; ++i)
      p[i] = displaced(p[i], -scale * gradient.segment<3>(3 * static_cast<Eigen::Index>(i)));
  }
  return p;
}

TEST(SymmetricSet, RadiusIsThatOfTheWholeSet) {
  const Rotations left = rotation_group("I");
  const Rotations right = rotation_group("C4");
  SymmetricSet set(left, right, 5);
  const Rotations p = spread_representatives(set, 5, 1);
  Eigen::Matrix4Xd all(4, 60 * 4 * 5);
  Eigen::Index column = 0;
  for (const auto& q : p)
    for (const auto& h : right)
      for (const auto& g : left) {
        const Eigen::Quaterniond member = g * q * h;
        all.col(column++) << member.w(), member.x(), member.y(), member.z();
      }
  const auto value = set.evaluate(p, 64.0);
  EXPECT_NEAR(value.radius, covering_radius(all), 1e-9);
  EXPECT_NEAR(reference::distance(all, value.deepest), value.radius, 1e-9);
}

TEST(SymmetricSet, GradientMeetsFiniteDifferences) {
  SymmetricSet set(rotation_group("I"), rotation_group("C2"), 6);
  Rotations p = spread_representatives(set, 6, 2);
  for (const double power : {8.0, 64.0}) {
    const Eigen::VectorXd gradient = set.evaluate(p, power).gradient;
    constexpr double kStep = 1e-6;
    for (std::size_t i = 0; i < p.size(); ++i)
      for (int axis = 0; axis < 3; ++axis) {
        const Eigen::Quaterniond home = p[i];
        p[i] = displaced(home, kStep * Eigen::Vector3d::Unit(axis));
        const double ahead = set.evaluate(p, power).f;
        p[i] = displaced(home, -kStep * Eigen::Vector3d::Unit(axis));
        const double behind = set.evaluate(p, power).f;
        p[i] = home;
        // Central differences of a step of 1e-6: rounding of f over the step rules.
        EXPECT_NEAR((ahead - behind) / (2.0 * kStep),
                    gradient(3 * static_cast<Eigen::Index>(i) + axis),
                    1e-4 * gradient.lpNorm<Eigen::Infinity>())
            << "representative " << i << " axis " << axis << " power " << power;
      }
  }
}

}  // namespace
}  // namespace mortise
