// SPDX-License-Identifier: GPL-3.0-or-later
// Argument checks shared by the rotations room.
#pragma once

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

}  // namespace mortise
