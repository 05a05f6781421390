// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Plain balls: a text file of x y z r [weight], and balls from any file that holds some.
#pragma once

#include <string>
#include <string_view>

#include "mortise/core/knots.hpp"

namespace mortise {

/// Balls as text (.xyzr). One ball a line: `x y z r` or `x y z r weight`, numbers with blanks
/// between them, in the body's own length unit; no weight means 1. `#` begins a comment, empty
/// lines are skipped, lines may end in CR LF.
/// @param path  names the text in errors
/// @throws FileError with path:line for a line that is no ball: not 4 or 5 numbers, one not finite,
/// a radius not > 0; without a line if there is no ball
[[nodiscard]] Knots parse_xyzr(const std::string& path, std::string_view text);

/// The same text again: a head of two comments, then a ball a line, with weights unless all are 1.
/// Numbers are the shortest that read back to the same bits.
/// @throws InputError as check_knots, or if a weight has an imaginary part
[[nodiscard]] std::string format_xyzr(const Knots& knots);

/// Balls of a knots file (what `mortise decompose` writes) or of an .xyzr file, whichever the
/// content says.
/// @throws FileError as read_knots_file and parse_xyzr
[[nodiscard]] Knots read_balls(const std::string& path);

/// Whether read_balls() is the reader for this file: an HDF5 file by its content, or a name that
/// ends in .xyzr, in any case.
/// @throws FileError if the file is missing or a damaged HDF5 file
[[nodiscard]] bool is_balls_file(const std::string& path);

/// Whether a name ends in .xyzr, in any case: the form in which balls are written.
[[nodiscard]] bool named_xyzr(const std::string& path);

/// Writes format_xyzr() as write_file_atomically does.
void write_xyzr(const std::string& path, const Knots& knots);

}  // namespace mortise
