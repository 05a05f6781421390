// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Numbers and texts as fields of CSV tables.
#pragma once

#include <array>
#include <charconv>
#include <cmath>
#include <string>

namespace mortise {

/// The shortest text that reads back to the same number, in any locale; empty for NaN.
inline std::string shortest(double value) {
  if (std::isnan(value)) return "";
  std::array<char, 32> buffer;
  const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return {buffer.data(), result.ptr};
}

/// RFC 4180: quoted where a comma, a quote or a line end is inside.
inline std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

}  // namespace mortise
