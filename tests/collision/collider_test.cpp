// SPDX-License-Identifier: GPL-3.0-or-later
// Certified answers against ball-by-ball truth, near contact and far.
#include "mortise/collision/collider.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "collision/bodies.hpp"
#include "mortise/collision/radial_instrument.hpp"
#include "mortise/core/errors.hpp"
#include "mortise/kernels/ball.hpp"

namespace mortise {
namespace {

using tests::random_knots;
using tests::random_pose;
using tests::random_rotation;

// The least distance of two balls less their radii: negative means they overlap.
double separation(const Knots& fixed, const Knots& moving, const RigidMotion& pose) {
  double least = std::numeric_limits<double>::infinity();
  for (Eigen::Index j = 0; j < moving.size(); ++j) {
    const Eigen::Vector3d y = pose * Eigen::Vector3d(moving.points.col(j).head<3>());
    for (Eigen::Index i = 0; i < fixed.size(); ++i)
      least = std::min(least, (fixed.points.col(i).head<3>() - y).norm() - fixed.points(3, i) -
                                  moving.points(3, j));
  }
  return least;
}

TEST(RadialInstrument, IsAKernelOfUnitIntegralWithoutHighFrequencies) {
  const RadialInstrument kernel(2.0);
  EXPECT_NEAR(kernel.transform(0.0), 1.0, 1e-12);
  EXPECT_EQ(kernel.transform(2.0), 0.0);
  EXPECT_LT(kernel.transform(1.9), 1e-4);
  EXPECT_NEAR(kernel.outside(0.0), 1.0, 1e-12);
  EXPECT_LT(kernel.outside(2.0), 1e-3);
  // A ball much larger than the kernel: the lens is its volume less what the shifts take, about a
  // mean shift's share.
  EXPECT_NEAR(kernel.lens(50.0) / (4.0 / 3.0 * std::numbers::pi * 50.0 * 50.0 * 50.0), 1.0, 0.02);
}

// Int K(x) lens(x) dx = Int K^(w) |ball^(w)|^2 dw, and Int |ball^|^2 is the ball's volume: with K^
// as used the two differ by no more than its error times the volume.
TEST(RadialInstrument, TheWindowIsTheKernelsToItsStatedError) {
  const RadialInstrument kernel(1.0);
  for (const double r : {0.2, 0.5, 1.2, 3.0}) {
    double sum = 0.0;
    constexpr int kPoints = 200000;
    for (int i = 0; i < kPoints; ++i) {
      const double k = (i + 0.5) / kPoints;
      sum += 4.0 * std::numbers::pi * k * k * kernel.transform(k) *
             std::pow(ball_transform(k, r), 2) / kPoints;
    }
    const double volume = 4.0 / 3.0 * std::numbers::pi * r * r * r;
    EXPECT_NEAR(kernel.lens(r), sum, RadialInstrument::kTransformError * volume) << r;
  }
  // The largest curvature is that at 0, which is what a linear table's error hangs on.
  constexpr double kStep = 16.0 / 2048.0;
  EXPECT_LT(2.0 * (1.0 - kernel.transform(kStep)) / (kStep * kStep) / (8.0 * 2048.0 * 2048.0),
            RadialInstrument::kTransformError);
}

struct Count {
  int no = 0, yes = 0, band = 0, by_sum = 0;
};

Knots grown(Knots knots, double by) {
  knots.points.row(3).array() += by;
  return knots;
}

TEST(Collider, AnswersAreNeverWrong) {
  const Eigen::Vector3d fixed_centre(1.0, 2.0, 3.0), moving_centre(-4.0, 0.0, 1.0);
  const Knots fixed = random_knots(60, 5.0, fixed_centre, 1),
              moving = random_knots(40, 4.0, moving_centre, 2);
  for (const int steps : {3, 30, 20000})
    for (const double margin : {0.0, 0.5}) {
      const Collider collider({grown(fixed, margin), margin}, {grown(moving, margin), margin},
                              {.modes = 600, .tree_steps = steps});
      std::mt19937_64 random(3);
      Count count;
      for (int i = 0; i < 150; ++i) {
        const RigidMotion pose = random_pose(fixed_centre, moving_centre, 24.0, random);
        const double gap = separation(fixed, moving, pose);
        const Collision answer = collider(pose);
        if (answer.contact == Contact::kNo) {
          EXPECT_GE(gap, 2.0 * margin - 1e-9);
          ++count.no;
        } else if (answer.contact == Contact::kYes) {
          EXPECT_LT(gap, 0.0);
          ++count.yes;
        } else {
          EXPECT_LE(gap - 2.0 * margin,
                    answer.by == DecidedBy::kTree ? 0.0 : collider.sum_band() - 2.0 * margin);
          ++count.band;
        }
        count.by_sum += answer.by == DecidedBy::kSum ? 1 : 0;
      }
      EXPECT_GT(count.no, 20);
      if (margin == 0.0) {  // exact, whatever the limit
        EXPECT_EQ(count.band + count.by_sum, 0);
        EXPECT_GT(count.yes, 2);
      } else if (steps == 3) {
        EXPECT_GT(count.by_sum, 20);
      } else if (steps == 20000) {
        EXPECT_EQ(count.by_sum, 0);
        EXPECT_GT(count.yes, 2);
        EXPECT_GT(count.band, 0);
      }
    }
}

// Far from the origin rounding is of the coordinates, not of the radii.
TEST(Collider, BallsThatTouchFarOutAreNotApart) {
  std::mt19937_64 random(8);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d far = 1e7 * (random_rotation(random) * Eigen::Vector3d::UnitX());
    const Knots a{(Eigen::Vector4d() << far, 1.0).finished(), Eigen::VectorXcd::Ones(1)},
        b{Eigen::Vector4d(0, 0, 0, 1.0), Eigen::VectorXcd::Ones(1)};
    // Overlapping by 1e-9, less than the coordinates resolve.
    const Eigen::Quaterniond turn = random_rotation(random);
    const RigidMotion pose{random_rotation(random),
                           far + (2.0 - 1e-9) * (turn * Eigen::Vector3d::UnitX())};
    EXPECT_NE(Collider({a, 0.0}, {b, 0.0}, {.modes = 200})(pose).contact, Contact::kNo);
  }
}

TEST(Collider, RefusesBadMotions) {
  const Knots ball{Eigen::Vector4d(0, 0, 0, 1), Eigen::VectorXcd::Ones(1)};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const int steps : {0, 20000}) {
    const Collider collider({ball, 0.0}, {ball, 0.0},
                            {.modes = 200, .tree_steps = steps, .threads = 1});
    const Eigen::Quaterniond none = Eigen::Quaterniond::Identity();
    EXPECT_THROW((void)collider({none, {nan, 0, 0}}), InputError);
    EXPECT_THROW((void)collider({Eigen::Quaterniond(1, 0, 0, nan), {0, 0, 0}}), InputError);
    EXPECT_THROW((void)collider({Eigen::Quaterniond(1, 30, 0, 0), {0, 0, 0}}), InputError);
    const GapFunction& gap = collider.gap_function();
    EXPECT_THROW((void)gap({none, {nan, 0, 0}}), InputError);
    EXPECT_THROW((void)gap({Eigen::Quaterniond(1, 30, 0, 0), {0, 0, 0}}), InputError);
    EXPECT_THROW((void)gap.exact({none, {nan, 0, 0}}), InputError);
    EXPECT_THROW((void)gap.reject({none, {nan, 0, 0}}, 1.0), InputError);
  }
}

// Two balls and many modes: the sum alone tells apart what is farther than its band.
TEST(Collider, TheSumAloneKeepsItsPromise) {
  const Knots ball{Eigen::Vector4d(0, 0, 0, 1), Eigen::VectorXcd::Ones(1)};
  const Collider collider({ball, 0.0}, {ball, 0.0}, {.modes = 20000, .tree_steps = 0});
  ASSERT_LT(collider.sum_band(), 2.5);
  int no = 0;
  for (double d = 0.0; d < 2.0 + 2.0 * collider.sum_band(); d += 0.05) {
    RigidMotion pose;
    pose.translation = d * Eigen::Vector3d(0.48, 0.6, 0.64);
    const Collision answer = collider(pose);
    EXPECT_EQ(answer.by, DecidedBy::kSum);
    if (answer.contact == Contact::kNo) {
      EXPECT_GE(d, 2.0);
      ++no;
    } else {
      EXPECT_LE(d, 2.0 + collider.sum_band());
    }
  }
  EXPECT_GT(no, 10);
}

TEST(Collider, RefusesBadInput) {
  const Knots knots = random_knots(5, 1.0, {0, 0, 0}, 1);
  EXPECT_THROW(Collider({knots, -1.0}, {knots, 0.0}), InputError);
  EXPECT_THROW(Collider({knots, 0.0}, {Knots{}, 0.0}), InputError);
  EXPECT_THROW(Collider({knots, 0.0}, {knots, 0.0}, {.tree_steps = -1}), InputError);
}

}  // namespace
}  // namespace mortise
