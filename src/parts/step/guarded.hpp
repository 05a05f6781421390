// SPDX-License-Identifier: GPL-3.0-or-later
// Work that may crash, done in a child process.
#pragma once

#include <functional>
#include <string>

namespace mortise {

/// The bytes that `work` returns. It runs in a forked child without core dumps, so that a crash or
/// an endless loop on a damaged file costs an error and not the program.
/// @param path     of the file that is read, for the message
/// @param seconds  processor time after which the child is ended
/// @throws FileError with work's own message if it throws, or if the child dies
[[nodiscard]] std::string guarded(const std::string& path, unsigned seconds,
                                  const std::function<std::string()>& work);

}  // namespace mortise
