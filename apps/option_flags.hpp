// SPDX-License-Identifier: GPL-3.0-or-later
// A run's table of options on the command line.
#pragma once

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "mortise/core/errors.hpp"
#include "mortise/runs/run_kind.hpp"

namespace mortise::app {

/// What the user asked for: a preset, and settings that go over it in the order given.
template <class Options>
struct OptionFlags {
  std::optional<std::string> preset;
  std::vector<std::function<void(Options&)>> overrides;
};

/// The flag of an option: "--per-rotation" of "per_rotation".
[[nodiscard]] inline std::string flag_of(const std::string& name) {
  std::string flag = "--" + name;
  std::replace(flag.begin(), flag.end(), '_', '-');
  return flag;
}

/// Adds one row; its default is shown from `defaults`.
template <class Options>
void add_row(CLI::App& command, OptionFlags<Options>& flags, Options defaults,
             const OptionRow<Options>& row) {
  const auto add = [&flags](auto change) { flags.overrides.emplace_back(std::move(change)); };
  const std::string flag = flag_of(row.name);
  if (const auto* form = std::get_if<TextForm<Options>>(&row.field)) {
    command
        .add_option_function<std::string>(
            flag,
            [add, flag, parse = form->parse](const std::string& text) {
              try {
                Options probe;
                parse(probe, text);
              } catch (const InputError& e) {
                throw InputError(flag + std::string(e.what()).substr(flag.size() - 2));
              }
              add([parse, text](Options& o) { parse(o, text); });
            },
            row.help)
        ->default_str(form->print(defaults));
  } else if (const auto* of = std::get_if<typename OptionRow<Options>::Switch>(&row.field)) {
    const std::string no = "--no-" + flag.substr(2);
    command
        .add_flag_function(
            flag + ",!" + no,
            [add, of = *of](std::int64_t count) {
              add([of, on = count > 0](Options& o) { of(o) = on; });
            },
            row.help)
        ->default_str((*of)(defaults) ? "on" : "off");
  } else {
    const auto add_value = [&](auto of_value) {
      using Value = std::decay_t<decltype(of_value(defaults))>;
      const nlohmann::ordered_json standard = of_value(defaults);
      command
          .add_option_function<Value>(
              flag,
              [add, of_value](const Value& value) {
                add([of_value, value](Options& o) { of_value(o) = value; });
              },
              row.help)
          ->default_str(standard == "" ? "none" : standard.dump());
    };
    if (const auto* real = std::get_if<typename OptionRow<Options>::Real>(&row.field))
      add_value(*real);
    else if (const auto* integer = std::get_if<typename OptionRow<Options>::Integer>(&row.field))
      add_value(*integer);
    else
      add_value(std::get<typename OptionRow<Options>::Text>(row.field));
  }
}

/// Adds --preset and every row of a kind's table, with the default preset's values.
template <class Options>
void add_option_flags(CLI::App& command, const RunKind<Options>& kind, OptionFlags<Options>& flags,
                      const std::string& preset_help = {}) {
  command
      .add_option(
          "--preset", flags.preset,
          "fast, default or thorough; the options below override it, and the values shown are "
          "those of default" +
              preset_help)
      ->default_str("default");
  for (const OptionRow<Options>& row : kind.rows())
    add_row(command, flags, kind.preset("default"), row);
}

/// `start` (the default preset if there is none), or the preset where one is asked for, and the
/// user's settings over it.
template <class Options>
[[nodiscard]] Options resolve(const RunKind<Options>& kind, const OptionFlags<Options>& flags,
                              const std::optional<Options>& start = {}) {
  Options options = start && !flags.preset ? *start : kind.preset(flags.preset.value_or("default"));
  for (const auto& change : flags.overrides) change(options);
  return options;
}

}  // namespace mortise::app
