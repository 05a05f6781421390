// SPDX-License-Identifier: GPL-3.0-or-later
// Contact potentials: kernels by hand, tables read and refused, maps against the sum over all
// pairs and against plain interpolation, slopes against differences.
#include "mortise/scoring/score_maps.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <sstream>

#include "helpers/random_motions.hpp"
#include "mortise/core/errors.hpp"
#include "mortise/molecules/contact_types.hpp"
#include "reference/linear_maps.hpp"

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
  const Eigen::Vector3d direction = tests::random_vector(generator).normalized();
  return {tests::random_rotation(generator), distance * direction};
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
  const PlacedPoints placed(moving);
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
      error += std::pow(
          maps.contact_score(placed, pose) - contact_score(fixed, moving, pose, potential), 2);
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

TEST(ScoreMaps, SameBytesForAnyNumberOfThreadsOneByOneOrTogetherAndNothingFarAway) {
  const TypedPoints fixed = random_body(200, 10.0, kContactTypes, 4);
  const PlacedPoints moving(random_body(100, 8.0, kContactTypes, 5));
  const ScoreMaps one(fixed, fitted_contact_potential(), {.threads = 1});
  const ScoreMaps two(fixed, fitted_contact_potential(), {.threads = 2});
  std::mt19937 generator(6);
  std::vector<RigidMotion> poses;
  for (int i = 0; i < 600; ++i) poses.push_back(random_contact(15.0, generator));
  const Eigen::VectorXd together = one.contact_scores(moving, poses, 1);
  EXPECT_EQ(together, two.contact_scores(moving, poses, 2));
  for (int i = 0; i < 600; i += 30) {
    EXPECT_EQ(one.contact_score(moving, poses[i]), together[i]);
    EXPECT_NE(together[i], 0.0);
  }
  EXPECT_EQ(one.contact_score(moving, random_contact(60.0, generator)), 0.0);
  EXPECT_EQ(one.contact_scores(moving, {}).size(), 0);
}

// Knots of two radii in two terms, and typed points of which half are knots.
struct Shaped {
  TypedPoints fixed = random_body(400, 12.0, kContactTypes, 8);
  TypedPoints moving = random_body(230, 9.0, kContactTypes, 9);
  ShapeTerms shape;
  Eigen::MatrixXd weights;  // 2 x moving points

  Shaped() {
    std::mt19937 generator(10);
    std::uniform_real_distribution<double> number(-1.0, 1.0);
    shape.points = random_body(300, 12.0, 1, 11).points;
    shape.weights = Eigen::VectorXd::NullaryExpr(300, [&] { return number(generator); });
    shape.kernel_of = Eigen::VectorXi::NullaryExpr(300, [](Eigen::Index i) { return i % 2; });
    shape.kernels.assign(2, std::vector<TabulatedKernel>(2));
    for (auto& term : shape.kernels)
      for (TabulatedKernel& kernel : term) {
        kernel = {11.0, std::vector<double>(500)};
        const double height = number(generator), turns = 5.0 * number(generator);
        for (int i = 0; i < 500; ++i)
          kernel.values[i] = height * std::pow(1.0 - i / 499.0, 2) * std::cos(turns * i / 499.0);
      }
    weights = Eigen::MatrixXd::NullaryExpr(2, 230, [&] { return number(generator); });
  }
  [[nodiscard]] reference::LinearMaps reference() const {
    // ScoreMaps' grid points: whole steps from the lowest coordinates less the contacts' range.
    const Eigen::Vector3d low =
        fixed.points.rowwise().minCoeff().cwiseMin(shape.points.rowwise().minCoeff());
    return {fixed, fitted_contact_potential(), shape, 1.0, low.array() - kContactRange};
  }
};

// Values are kept to 8 bits after the first, so that each errs by 2^-9 at most and by about a third
// of that in the mean; a hundred and more of either sign add up. 1e-3 is five times what is found.
TEST(ScoreMaps, ReadWhatPlainInterpolationGives) {
  const Shaped c;
  const ScoreMaps maps(c.fixed, fitted_contact_potential(), c.shape, {.threads = 2});
  const PlacedPoints placed(c.moving, c.moving.points, c.weights);
  const reference::LinearMaps reference = c.reference();
  std::mt19937 generator(12);
  double value_error = 0.0, force_error = 0.0, torque_error = 0.0, value = 0.0, force = 0.0,
         torque = 0.0;
  for (int i = 0; i < 12; ++i) {
    const RigidMotion pose = random_contact(14.0 + i, generator);
    const PlacedScore found = maps.slope(placed, pose);
    const PlacedScore expected = reference.slope(c.moving, c.weights, placed.centre, pose);
    value_error += std::pow(found.value - expected.value, 2);
    force_error += (found.force - expected.force).squaredNorm();
    torque_error += (found.torque - expected.torque).squaredNorm();
    value += std::pow(expected.value, 2);
    force += expected.force.squaredNorm();
    torque += expected.torque.squaredNorm();
    const auto [shape, contact] = maps.terms(placed, pose);
    EXPECT_NEAR(shape + contact, found.value, 1e-12 * (std::abs(shape) + std::abs(contact)));
    EXPECT_EQ(contact, maps.contact_score(placed, pose));
    EXPECT_GT(std::abs(shape), 0.01);
    EXPECT_GT(std::abs(contact), 0.01);
  }
  EXPECT_LT(std::sqrt(value_error / value), 1e-3);
  // Slopes are differences of neighbours, of which the same errors are a larger part: 0.7 and 0.8%
  // are found.
  EXPECT_LT(std::sqrt(force_error / force), 2e-2);
  EXPECT_LT(std::sqrt(torque_error / torque), 2e-2);
}

TEST(ScoreMaps, TheReferencesSlopesAreThoseOfItsValue) {
  const Shaped c;
  const reference::LinearMaps reference = c.reference();
  std::mt19937 generator(13);
  const RigidMotion pose = random_contact(16.0, generator);
  const Eigen::Vector3d centre(1.0, -2.0, 0.5);
  const PlacedScore score = reference.slope(c.moving, c.weights, centre, pose);
  constexpr double kStep = 1e-6;  // hardly a point passes into another cell
  for (int d = 0; d < 3; ++d) {
    const auto moved = [&](double step, bool turn) {
      const Eigen::Vector3d axis = Eigen::Vector3d::Unit(d);
      RigidMotion result = pose;
      if (turn) result.rotation = Eigen::AngleAxisd(step, axis) * pose.rotation;
      result.translation = pose * centre + (turn ? 0.0 : step) * axis - result.rotation * centre;
      return reference.slope(c.moving, c.weights, centre, result).value;
    };
    EXPECT_NEAR((moved(kStep, false) - moved(-kStep, false)) / (2.0 * kStep), score.force[d],
                1e-5 * score.force.norm());
    EXPECT_NEAR((moved(kStep, true) - moved(-kStep, true)) / (2.0 * kStep), score.torque[d],
                1e-5 * score.torque.norm());
  }
}

TEST(ScoreMaps, TakeBodiesOfAnySizeAndPlace) {
  const ContactPotential& potential = fitted_contact_potential();
  std::mt19937 generator(14);
  for (const int count : {1, 16, 17, 40}) {
    const TypedPoints fixed = random_body(count, 6.0, kContactTypes, 15);
    TypedPoints moving = random_body(count, 5.0, kContactTypes, 16);
    moving.points.colwise() += Eigen::Vector3d(1e3, -2e3, 500.0);
    const ScoreMaps maps(fixed, potential, {.spacing = 0.5});
    const PlacedPoints placed(moving);
    for (int i = 0; i < 5; ++i) {
      RigidMotion pose = random_contact(9.0, generator);
      pose.translation -= pose.rotation * Eigen::Vector3d(1e3, -2e3, 500.0);
      EXPECT_NEAR(maps.contact_score(placed, pose), contact_score(fixed, moving, pose, potential),
                  0.01 * count)
          << count;
    }
  }
  const TypedPoints none{Eigen::Matrix3Xd(3, 0), Eigen::VectorXi(0)};
  EXPECT_EQ(ScoreMaps(none, potential).contact_score(PlacedPoints(none), {}), 0.0);
}

TEST(ScoreMaps, RefusesBadInput) {
  const ContactPotential potential = parse_contact_potential(kTable, 2, "table");
  TypedPoints body = random_body(5, 3.0, 2, 7);
  EXPECT_THROW(ScoreMaps(body, potential, {.spacing = 0.0}), InputError);
  body.types[0] = 2;
  EXPECT_THROW(ScoreMaps(body, potential), InputError);
  EXPECT_THROW((void)ScoreMaps(random_body(5, 3.0, 2, 7), potential)
                   .contact_score(PlacedPoints(body), RigidMotion{}),
               InputError);
  body.types.conservativeResize(4);
  EXPECT_THROW(ScoreMaps(body, potential), InputError);
  EXPECT_THROW(PlacedPoints{body}, InputError);
  Shaped c;
  c.shape.kernels[1][0].range = 10.0;
  EXPECT_THROW(ScoreMaps(c.fixed, fitted_contact_potential(), c.shape), InputError);
  c.shape.kernels[1].pop_back();
  EXPECT_THROW(ScoreMaps(c.fixed, fitted_contact_potential(), c.shape), InputError);
}

}  // namespace
}  // namespace mortise
