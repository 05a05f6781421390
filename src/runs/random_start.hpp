// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A motion that hides the right answer from a test on bodies that already sit right.
#pragma once

#include <cstdint>

#include "mortise/core/rigid_motion.hpp"

namespace mortise {

/// A random rotation and a translation of up to `reach` per axis, the same for a seed everywhere.
[[nodiscard]] RigidMotion random_start(std::uint64_t seed, double reach);

}  // namespace mortise
