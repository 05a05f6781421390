// SPDX-License-Identifier: GPL-3.0-or-later
// Wall time since a moment.
#pragma once

#include <chrono>

namespace mortise::app {

using Clock = std::chrono::steady_clock;

[[nodiscard]] inline double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

}  // namespace mortise::app
