// SPDX-License-Identifier: GPL-3.0-or-later
// The best poses of a run as lines of text.
#pragma once

#include <string>

#include "mortise/store/run_file.hpp"

namespace mortise::app {

/// A head and one line for each of the best `count` poses: rank, score, channels, metrics if there
/// are any, else quaternion and translation.
[[nodiscard]] std::string pose_table(const Run& run, std::size_t count);

}  // namespace mortise::app
