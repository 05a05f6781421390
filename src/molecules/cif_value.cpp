// SPDX-License-Identifier: GPL-3.0-or-later
// Quoting of CIF values.
#include "molecules/cif_value.hpp"

#include <string_view>

#include "mortise/core/errors.hpp"

namespace mortise::molecules {

std::string cif_value(const std::string& value) {
  if (value.empty()) return ".";
  const std::string_view specials = "_#$'\"[];";
  const bool reserved = value == "." || value == "?" || value.starts_with("data_") ||
                        value.starts_with("loop_") || value.starts_with("save_") ||
                        value.starts_with("stop_") || value.starts_with("global_");
  if (!reserved && value.find_first_of(" \t\r\n") == std::string::npos &&
      specials.find(value[0]) == std::string_view::npos)
    return value;
  if (value.find_first_of("\r\n") == std::string::npos)
    for (const char quote : {'\'', '"'})
      if (value.find(quote) == std::string::npos) return quote + value + quote;
  throw InputError("mmCIF output: expected a name that fits in quotes, found: " + value);
}

}  // namespace mortise::molecules
