// SPDX-License-Identifier: GPL-3.0-or-later
// Ctrl-C while there is nothing to save.
#pragma once

#include <string>

namespace mortise::app {

/// From now on SIGINT and SIGTERM end the program at once with 130 and "mortise: interrupted: " +
/// message: for work that is not asked whether to go on. install_interrupt_handler() ends this.
void exit_at_once_on_interrupt(const std::string& message);

}  // namespace mortise::app
