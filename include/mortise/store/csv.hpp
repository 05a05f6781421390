// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Lines of CSV tables as RFC 4180 has them, without line ends within a cell.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace mortise {

/// The cells of one line, at least one; a line end at its end does not count.
[[nodiscard]] std::vector<std::string> csv_cells(std::string_view line);

/// The text as a cell: quoted where a comma, a quote or a line end is inside.
[[nodiscard]] std::string csv_field(const std::string& text);

/// The shortest text that reads back to the same number, in any locale; empty for NaN.
[[nodiscard]] std::string shortest(double value);

}  // namespace mortise
