// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A file as one string.
#pragma once

#include <string>

namespace mortise {

/// The whole file.
/// @param expected  what the message says should have been there
/// @throws FileError if it is missing, a directory or unreadable
[[nodiscard]] std::string read_whole_file(const std::string& path,
                                          const std::string& expected = "a file");

}  // namespace mortise
