// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Options by their table: check, to JSON and back.
#pragma once

#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "mortise/core/errors.hpp"
#include "mortise/runs/option_row.hpp"

namespace mortise {

/// A number as people write it, and as it reads back: "0.25", not "0.250000".
[[nodiscard]] inline std::string short_number(double value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

/// @throws InputError naming `who`, the option, its range and what was found
template <class Options>
void check_options(const char* who, std::span<const OptionRow<Options>> rows, Options options) {
  for (const OptionRow<Options>& row : rows) {
    double value = 0.0;
    if (const auto* real = std::get_if<typename OptionRow<Options>::Real>(&row.field))
      value = (*real)(options);
    else if (const auto* integer = std::get_if<typename OptionRow<Options>::Integer>(&row.field))
      value = (*integer)(options);
    else
      continue;
    const bool low = row.above_least ? value > row.least : value >= row.least;
    if (low && value <= row.most && std::isfinite(value)) continue;  // NaN fails
    std::string range = std::string(row.above_least ? "> " : ">= ") + short_number(row.least);
    if (std::isfinite(row.most)) range += " and <= " + short_number(row.most);
    throw InputError(std::string(who) + ": " + row.name + " must be " + range +
                     (std::isfinite(value) ? "" : " and finite") + ", got " + short_number(value));
  }
}

template <class Options>
[[nodiscard]] nlohmann::ordered_json options_json(std::span<const OptionRow<Options>> rows,
                                                  Options options) {
  nlohmann::ordered_json json;
  for (const OptionRow<Options>& row : rows)
    std::visit(
        [&](const auto& field) {
          if constexpr (std::is_same_v<std::decay_t<decltype(field)>, TextForm<Options>>)
            json[row.name] = field.print(options);
          else
            json[row.name] = field(options);
        },
        row.field);
  return json;
}

/// Options from what options_json() gave. @throws InputError unless it names each row and no other
template <class Options>
[[nodiscard]] Options parse_options(std::span<const OptionRow<Options>> rows,
                                    const std::string& text) {
  Options options;
  try {
    const nlohmann::json json = nlohmann::json::parse(text);
    for (const OptionRow<Options>& row : rows)
      std::visit(
          [&](const auto& field) {
            if constexpr (std::is_same_v<std::decay_t<decltype(field)>, TextForm<Options>>) {
              field.parse(options, json.at(row.name).template get<std::string>());
            } else {
              using Value = std::decay_t<decltype(field(options))>;
              field(options) = json.at(row.name).template get<Value>();
            }
          },
          row.field);
    for (const auto& item : json.items()) {
      bool known = false;
      for (const OptionRow<Options>& row : rows) known = known || item.key() == row.name;
      if (!known)
        throw InputError("the run's option " + item.key() + " is not one of this program");
    }
  } catch (const nlohmann::json::exception& e) {
    throw InputError(std::string("the run's options are not those of this program: ") + e.what());
  }
  return options;
}

}  // namespace mortise
