// SPDX-License-Identifier: GPL-3.0-or-later
// What `dock` and `mate` share as commands: output file, resuming, progress, figures, JSON.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "commands.hpp"
#include "search_job.hpp"

namespace mortise::app {

/// The options that every search command has.
struct SearchOptionsCommon {
  CommonOptions common;
  std::string fixed;
  std::string moving;
  std::string output;
  double checkpoint_seconds = SearchWatch{}.checkpoint_seconds;
  bool resume = false;
  bool force = false;
};

/// Adds --resume, --force, --checkpoint and the common options.
void add_search_flags(CLI::App& command, SearchOptionsCommon& options, const std::string& examples);

/// A preset and settings that go over it, in the order given. Settings has a member `options`.
template <class Settings>
struct SearchArguments {
  std::optional<std::string> preset;
  std::vector<std::function<void(Settings&)>> overrides;
};

/// One option as the command line, the JSON of a run and the options struct know it.
template <class Options, class Value>
struct OptionField {
  const char* key;   ///< in to_json(Options)
  const char* flag;  ///< on the command line
  const char* help;
  Value& (*of)(Options&);
};

/// Adds the option of a field; its default is shown from `defaults`.
template <class Settings, class Options, class Value>
void add_option_field(CLI::App& command, SearchArguments<Settings>& arguments, Options defaults,
                      const OptionField<Options, Value>& field) {
  const nlohmann::ordered_json standard = field.of(defaults);
  const std::string shown = standard == "" ? "none" : standard.dump();
  auto of = field.of;
  command
      .add_option_function<Value>(
          field.flag,
          [&arguments, of](const Value& value) {
            arguments.overrides.emplace_back([of, value](Settings& s) { of(s.options) = value; });
          },
          field.help)
      ->default_str(shown);
}

/// Adds --random-start. Settings has a member `random_start`.
template <class Settings>
void add_random_start(CLI::App& command, SearchArguments<Settings>& arguments,
                      const std::string& help) {
  command
      .add_option_function<std::uint64_t>(
          "--random-start",
          [&arguments](const std::uint64_t& seed) {
            arguments.overrides.emplace_back([seed](Settings& s) { s.random_start = seed; });
          },
          help)
      ->default_str("none");
}

/// Throws InputError naming `who` and the first setting in which the two differ.
void expect_same_settings(const nlohmann::ordered_json& recorded,
                          const nlohmann::ordered_json& asked, const std::string& who);

/// What a search command does that is its own: the bodies and the engine.
class SearchCommand {
 public:
  virtual ~SearchCommand() = default;

  [[nodiscard]] virtual std::string name() const = 0;   ///< of the command and the run's kind
  [[nodiscard]] virtual std::string label() const = 0;  ///< of the progress bar
  /// The file that an input names.
  [[nodiscard]] virtual std::string file_of(const std::string& text) const = 0;
  /// Takes up an earlier run's settings; throws if the command line asks for others.
  virtual void take_settings(const Run& earlier) = 0;
  /// Makes the settings from the command line; returns them as JSON and the seed.
  [[nodiscard]] virtual std::pair<std::string, std::uint64_t> make_settings() = 0;
  /// Reads both inputs: of an earlier run, verified, or anew.
  virtual void read(const Run* earlier) = 0;
  [[nodiscard]] virtual SearchResult search(const Provenance& provenance, const SearchWatch& watch,
                                            const Run* earlier) = 0;
  /// Lines on what reading an input had to decide, each with the input's name.
  [[nodiscard]] virtual std::vector<std::string> decisions() const = 0;
  virtual void print_inputs() const = 0;
  [[nodiscard]] virtual std::string unit() const = 0;  ///< of lengths, for people
  /// Commands to go on with, one per line, for the shell-quoted run file.
  [[nodiscard]] virtual std::string next_steps(const std::string& output) const = 0;
};

/// The whole command: checks, reading, search with checkpoints, figures, output.
void run_search_command(SearchCommand& command, const SearchOptionsCommon& options);

}  // namespace mortise::app
