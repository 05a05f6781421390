// SPDX-License-Identifier: GPL-3.0-or-later
// Super-Fibonacci spirals: an even set of any number of rotations in closed form.
#include <cmath>
#include <numbers>

#include "mortise/core/rigid_motion.hpp"
#include "mortise/rotations/rotation_set.hpp"
#include "rotations/checks.hpp"

namespace mortise {

Eigen::Matrix4Xd super_fibonacci_rotations(Eigen::Index count) {
  check_rotation_count(count, "super_fibonacci_rotations");
  constexpr double kPhi = std::numbers::sqrt2;
  constexpr double kPsi = 1.533751168755204288118041;  // psi^4 = psi + 4
  Eigen::Matrix4Xd quaternions(4, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const double s = static_cast<double>(i) + 0.5;
    const double t = s / static_cast<double>(count);
    const double inner = std::sqrt(t);
    const double outer = std::sqrt(1.0 - t);
    // Whole turns are dropped before scaling by 2 pi: angles of large i keep their digits.
    const double alpha = 2.0 * std::numbers::pi * std::fmod(s / kPhi, 1.0);
    const double beta = 2.0 * std::numbers::pi * std::fmod(s / kPsi, 1.0);
    const Eigen::Quaterniond q = canonical({outer * std::cos(beta), inner * std::sin(alpha),
                                            inner * std::cos(alpha), outer * std::sin(beta)});
    quaternions.col(i) << q.w(), q.x(), q.y(), q.z();
  }
  return quaternions;
}

}  // namespace mortise
