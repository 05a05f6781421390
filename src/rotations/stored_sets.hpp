// SPDX-License-Identifier: GPL-3.0-or-later
// The sets that ship with the library.
#pragma once

#include <optional>

#include "mortise/rotations/rotation_set.hpp"

namespace mortise {

/// The stored set of this size, with the covering radius its table gives; nothing if there is none.
/// Column 60 i + g is group member g times representative i.
[[nodiscard]] std::optional<RotationSet> stored_rotation_set(Eigen::Index count);

}  // namespace mortise
