// SPDX-License-Identifier: GPL-3.0-or-later
// mortise dock: searches all placements of one molecule against another.
#include "commands.hpp"

namespace mortise::app {
void add_dock(CLI::App&) {}
}  // namespace mortise::app
