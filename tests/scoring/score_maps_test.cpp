// SPDX-License-Identifier: GPL-3.0-or-later
// Contact potentials: kernels by hand, tables read and refused, maps against the sum over all
// pairs.
#include "mortise/scoring/score_maps.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <sstream>

#include "mortise/core/errors.hpp"
#include "mortise/molecules/contact_types.hpp"

namespace mortise {
namespace {

// Two types: like attracts like, near; unlike repels, far.
const char* const kTable =
    "# a comment\nshape 0.5\nnear\n1 -0.25\n-0.25 2\n\nfar\n0 -1\n-1 0.125\n";

TypedPoints random_body(int count, double radius, int types, std::uint32_t seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> side(-radius, radius);
  std::uniform_int_distribution<int> type(-1, types - 1);  // -1: takes no part
  TypedPoints body{Eigen::Matrix3Xd(3, count), Eigen::VectorXi(count)};
  for (int i = 0; i < count;) {
    const Eigen::Vector3d p(side(generator), side(generator), side(generator));
    if (p.norm() > radius) continue;
    body.points.col(i) = p;
    body.types[i++] = type(generator);
  }
  return body;
}

RigidMotion random_contact(double distance, std::mt19937& generator) {
  std::normal_distribution<double> normal;
  const Eigen::Vector3d direction(normal(generator), normal(generator), normal(generator));
  return {canonical({normal(generator), normal(generator), normal(generator), normal(generator)}),
          distance * direction.normalized()};
}

TEST(ContactKernels, StepsByHand) {
  EXPECT_EQ(near_contact(0.0), 1.0);
  EXPECT_EQ(near_contact(5.0), 1.0);
  EXPECT_DOUBLE_EQ(near_contact(6.0), 0.5);
  EXPECT_EQ(near_contact(7.0), 0.0);
  EXPECT_EQ(far_contact(5.0), 0.0);
  EXPECT_DOUBLE_EQ(far_contact(6.0), 0.5);
  EXPECT_EQ(far_contact(8.0), 1.0);
  EXPECT_DOUBLE_EQ(far_contact(9.0), 0.5);
  EXPECT_EQ(far_contact(kContactRange), 0.0);
  EXPECT_EQ(far_contact(50.0), 0.0);
}

TEST(ContactScore, TwoPointsByHand) {
  const ContactPotential potential = parse_contact_potential(kTable, 2, "table");
  const TypedPoints a{Eigen::Vector3d::Zero(), Eigen::VectorXi::Constant(1, 0)};
  const TypedPoints b{Eigen::Vector3d::Zero(), Eigen::VectorXi::Constant(1, 1)};
  const RigidMotion apart{Eigen::Quaterniond::Identity(), {0.0, 6.0, 0.0}};
  EXPECT_NEAR(contact_score(a, b, apart, potential), -0.25 * 0.5 - 1.0 * 0.5, 1e-14);
  EXPECT_NEAR(contact_score(b, b, apart, potential), 2.0 * 0.5 + 0.125 * 0.5, 1e-14);
}

TEST(ContactPotentialTable, ReadsWhatItShouldAndRefusesTheRest) {
  const ContactPotential potential = parse_contact_potential(kTable, 2, "table");
  EXPECT_EQ(potential.shape, 0.5);
  EXPECT_EQ(potential.near(1, 1), 2.0);
  EXPECT_EQ(potential.far(0, 1), -1.0);
  for (const char* bad :
       {"", "near\n1 0\n0 1\n", "shape x\n", "shape 1\nnear\n1 0\n", "shape 1\nnear\n1 0 3\n0 1\n",
        "shape 1\nnear\n1 0\n0 nan\nfar\n1 0\n0 1\n", "shape 1\nnear\n1 2\n0 1\nfar\n1 0\n0 1\n"})
    EXPECT_THROW((void)parse_contact_potential(bad, 2, "table"), FileError) << bad;
  try {
    (void)parse_contact_potential("shape 1\nnear\n1 0\n0 what\n", 2, "table");
    FAIL() << "accepted a word as a number";
  } catch (const FileError& error) {
    EXPECT_EQ(error.line(), 4);
  }
  EXPECT_THROW((void)read_contact_potential("no/such/file", 2), FileError);
}

TEST(ContactPotentialTable, TheBuiltInOneIsThereForAllTypes) {
  const ContactPotential& potential = fitted_contact_potential();
  EXPECT_EQ(potential.near.rows(), kContactTypes);
  EXPECT_EQ(potential.far.cols(), kContactTypes);
  EXPECT_GT(potential.near.norm(), 0.0);
  EXPECT_GT(potential.shape, 0.0);
}

// Half the spacing, less than half the error: a quarter of it between the corners of the kernels,
// half of it at them. Relative to the root mean square score; about 1.8% at the default spacing.
TEST(ScoreMaps, ApproachTheSumOverPairsWithFinerSpacing) {
  const ContactPotential& potential = fitted_contact_potential();
  const TypedPoints fixed = random_body(900, 14.0, kContactTypes, 1);
  const TypedPoints moving = random_body(500, 11.0, kContactTypes, 2);
  std::mt19937 generator(3);
  std::vector<RigidMotion> poses;
  for (int i = 0; i < 40; ++i) poses.push_back(random_contact(20.0 + 0.2 * i, generator));
  double previous = 0.0, size = 0.0;
  for (const RigidMotion& pose : poses)
    size += std::pow(contact_score(fixed, moving, pose, potential), 2);
  for (const double spacing : {2.0, 1.0, 0.5}) {
    const ScoreMaps maps(fixed, potential, {.spacing = spacing});
    double error = 0.0;
    for (const RigidMotion& pose : poses)
      error +=
          std::pow(maps.score(moving, pose) - contact_score(fixed, moving, pose, potential), 2);
    const double relative = std::sqrt(error / size);
    if (spacing == 1.0) {
      EXPECT_LT(relative, 0.04);
    }
    if (previous > 0.0) {
      EXPECT_LT(relative, 0.5 * previous) << spacing;
    }
    previous = relative;
  }
}

TEST(ScoreMaps, SameBytesForAnyNumberOfThreadsAndNothingFarAway) {
  const TypedPoints fixed = random_body(200, 10.0, kContactTypes, 4);
  const TypedPoints moving = random_body(100, 8.0, kContactTypes, 5);
  const ScoreMaps one(fixed, fitted_contact_potential(), {.threads = 1});
  const ScoreMaps two(fixed, fitted_contact_potential(), {.threads = 2});
  std::mt19937 generator(6);
  for (int i = 0; i < 20; ++i) {
    const RigidMotion pose = random_contact(15.0, generator);
    EXPECT_EQ(one.score(moving, pose), two.score(moving, pose));
  }
  EXPECT_EQ(one.score(moving, random_contact(60.0, generator)), 0.0);
}

TEST(ScoreMaps, RefusesBadInput) {
  const ContactPotential potential = parse_contact_potential(kTable, 2, "table");
  TypedPoints body = random_body(5, 3.0, 2, 7);
  EXPECT_THROW(ScoreMaps(body, potential, {.spacing = 0.0}), InputError);
  body.types[0] = 2;
  EXPECT_THROW(ScoreMaps(body, potential), InputError);
  body.types.conservativeResize(4);
  EXPECT_THROW(ScoreMaps(body, potential), InputError);
}

}  // namespace
}  // namespace mortise
