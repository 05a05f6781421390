// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Replacing a file so that a reader, or a crash at any moment, sees the old bytes or the new ones.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "mortise/core/read_file.hpp"  // IWYU pragma: export

namespace mortise {

/// Writes `bytes` to `path` in one step: a hidden file beside it, fsync, rename, fsync of the
/// directory.
///
/// Writers of one path wait for each other. What a killed writer left behind is overwritten by the
/// next. A symbolic link is followed.
/// @throws FileError if the directory is missing or not writable, or the disk is full; the old file
/// then stands
void write_file_atomically(const std::string& path, std::string_view bytes);

/// Throws FileError unless write_file_atomically(path) could write `bytes` now. Call it before a
/// long computation.
void check_writable(const std::string& path, std::uint64_t bytes = 1 << 20);

}  // namespace mortise
