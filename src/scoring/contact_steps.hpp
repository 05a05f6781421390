// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Where the contact potential's kernels bend. Constants only.
#pragma once

namespace mortise {

// K1 is 1 up to kFarStart and falls to 0 at kNearEnd, where K2 has risen to 1; K2 falls to 0 over
// the last angstrom before kFarEnd.
inline constexpr float kFarStart = 5.0F;
inline constexpr float kNearEnd = 7.0F;
inline constexpr float kContactStep = kNearEnd - kFarStart;
inline constexpr float kFarEnd = 9.5F;

}  // namespace mortise
