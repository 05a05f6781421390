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
  // The inverse transform at the lens's own place: Int K(x) lens(x) dx = Int K^(w) |ball^(w)|^2 dw.
  double sum = 0.0;
  const int steps = 20000;
  for (int i = 0; i < steps; ++i) {
    const double k = 2.0 * (i + 0.5) / steps;
    sum += 4.0 * std::numbers::pi * k * k * kernel.transform(k) *
           std::pow(ball_transform(k, 0.4), 2) * 2.0 / steps;
  }
  EXPECT_NEAR(kernel.lens(0.4), sum, 1e-3 * sum);  // the table of K^ is linear between 512 nodes
}

struct Count {
  int no = 0, yes = 0, band = 0, by_sum = 0;
};

TEST(Collider, AnswersAreNeverWrong) {
  const Eigen::Vector3d fixed_centre(1.0, 2.0, 3.0), moving_centre(-4.0, 0.0, 1.0);
  const Knots fixed = random_knots(60, 5.0, fixed_centre, 1),
              moving = random_knots(40, 4.0, moving_centre, 2);
  for (const int steps : {30, 20000})
    for (const double cover : {0.0, 0.5}) {
      const Collider collider({fixed, cover}, {moving, cover},
                              {.modes = 1000, .tree_steps = steps});
      std::mt19937_64 random(3);
      Count count;
      for (int i = 0; i < 150; ++i) {
        const RigidMotion pose = random_pose(fixed_centre, moving_centre, 16.0, random);
        const double gap = separation(fixed, moving, pose);
        const Collision answer = collider(pose);
        // Balls are in the body, and the body in the grown balls.
        if (answer.contact == Contact::kNo) {
          EXPECT_GE(gap, 2.0 * cover - 1e-9);
          ++count.no;
        } else if (answer.contact == Contact::kYes) {
          EXPECT_LT(gap, 0.0);
          ++count.yes;
        } else {
          EXPECT_LE(gap,
                    answer.by == DecidedBy::kTree ? collider.tree_band() : collider.sum_band());
          ++count.band;
        }
        count.by_sum += answer.by == DecidedBy::kSum ? 1 : 0;
      }
      RecordProperty("no_" + std::to_string(steps), count.no);
      if (steps > 0) {
        EXPECT_GT(count.no, 20);
      }
      if (steps > 1000) {
        EXPECT_GT(count.yes, 10);
      }
      if (steps > 1000 && cover == 0.0) {
        EXPECT_EQ(count.band, 0);  // exact
      }
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
