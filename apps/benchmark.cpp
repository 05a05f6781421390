// SPDX-License-Identifier: GPL-3.0-or-later
// mortise benchmark: docks a table of known complexes and counts successes.
#include "commands.hpp"

namespace mortise::app {
void add_benchmark(CLI::App&) {}
}  // namespace mortise::app
