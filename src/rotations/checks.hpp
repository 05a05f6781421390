// SPDX-License-Identifier: GPL-3.0-or-later
// Argument checks shared by the rotations room.
#pragma once

#include <cmath>
#include <string>

#include "mortise/core/errors.hpp"
#include "mortise/rotations/rotation_set.hpp"

namespace mortise {

/// Throws InputError naming `who` unless 1 <= count <= kMaxRotations.
inline void check_rotation_count(Eigen::Index count, const char* who) {
  if (count < 1 || count > kMaxRotations)
    throw InputError(std::string(who) + ": count must be 1 to " + std::to_string(kMaxRotations) +
                     ", got " + std::to_string(count));
}

/// Throws InputError naming `who` unless there is a column and all are of unit length to 1e-6.
inline void check_quaternions(const Eigen::Matrix4Xd& quaternions, const char* who) {
  if (quaternions.cols() == 0)
    throw InputError(std::string(who) + ": expected at least one quaternion, got none");
  for (Eigen::Index i = 0; i < quaternions.cols(); ++i)
    if (!(std::abs(quaternions.col(i).norm() - 1.0) < 1e-6))  // written so that NaN fails too
      throw InputError(std::string(who) + ": expected unit quaternions, got norm " +
                       std::to_string(quaternions.col(i).norm()) + " in column " +
                       std::to_string(i));
}

}  // namespace mortise
