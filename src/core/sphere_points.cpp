// SPDX-License-Identifier: GPL-3.0-or-later
// The Fibonacci lattice on the sphere.
#include "core/sphere_points.hpp"

#include <cmath>
#include <numbers>

namespace mortise::detail {

Eigen::Matrix3Xd fibonacci_sphere(int count) {
  Eigen::Matrix3Xd points(3, count);
  const double golden_angle = std::numbers::pi * (3.0 - std::sqrt(5.0));
  for (int i = 0; i < count; ++i) {
    const double z = 1.0 - (2.0 * i + 1.0) / count;
    const double ring = std::sqrt(1.0 - z * z);
    points.col(i) << ring * std::cos(golden_angle * i), ring * std::sin(golden_angle * i), z;
  }
  return points;
}

}  // namespace mortise::detail
