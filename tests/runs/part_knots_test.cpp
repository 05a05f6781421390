// SPDX-License-Identifier: GPL-3.0-or-later
// Parts as balls: volume and bounds kept, radii capped.
#include "runs/part_knots.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "reference/analytic_solids.hpp"

namespace mortise {
namespace {

constexpr double kPi = std::numbers::pi;

LocalFrame frame() { return {Eigen::Vector3d(1.0, -2.0, 5.0), 10.0}; }

TEST(PartBalls, FillABoxOnceAndStayInIt) {
  const auto box = reference::make_box({-0.5, -0.3, -0.2}, {0.5, 0.3, 0.2});
  const double step = 0.02, epsilon = 0.5 * std::sqrt(3.0) * step;
  for (const double largest : {0.05, 0.1, 1.0}) {
    const Knots balls = part_balls("fixed", frame(), *box, {.step = step, .largest = largest});
    // In the input frame, ten times as large.
    EXPECT_LE(balls.points.row(3).maxCoeff(), 10.0 * (largest + 0.5 * epsilon) * (1 + 1e-6));
    const double volume = (balls.weights.real().array() *
                           balls.points.row(3).transpose().array().pow(3) * 4.0 / 3.0 * kPi)
                              .sum();
    // Shares divide what the balls hold, so that the sum is the box's volume, 8 x 0.5 x 0.3 x 0.2
    // of 10^3, but for a layer of epsilon on its surface of 2.48 x 10^2.
    EXPECT_NEAR(volume, 240.0, 248.0 * 10.0 * epsilon) << largest;
    const Eigen::Array3d half(5.0, 3.0, 2.0);
    for (Eigen::Index i = 0; i < balls.size(); ++i)
      EXPECT_TRUE((((balls.points.col(i).head<3>() - frame().centre).array().abs() +
                    balls.points(3, i)) <= half + 10.0 * epsilon + 1e-6)
                      .all());
  }
}

TEST(PartBalls, SmallerOnesAreMore) {
  const auto box = reference::make_box({-0.5, -0.3, -0.2}, {0.5, 0.3, 0.2});
  EXPECT_GT(part_balls("fixed", frame(), *box, {.largest = 0.05}).size(),
            part_balls("fixed", frame(), *box, {.largest = 1.0}).size());
}

}  // namespace
}  // namespace mortise
