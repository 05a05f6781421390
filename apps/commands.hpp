// SPDX-License-Identifier: GPL-3.0-or-later
// What every subcommand shares: how it is added to the program and how it talks to the user.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

namespace mortise::app {

/// Options every subcommand has.
struct CommonOptions {
  int threads = 0;     ///< 0 = all cores
  bool quiet = false;  ///< no progress, no warnings, no table
  bool json = false;   ///< one JSON object on stdout instead of text
};

/// Adds --threads, --quiet and --json to a subcommand and `examples` to the foot of its help.
void add_common_options(CLI::App& command, CommonOptions& options, const std::string& examples);

/// A unit interval [0, 1] progress bar with rate and time left on a terminal's stderr; silent
/// otherwise or if quiet. Returns a callback that also stops the work (returns false) after Ctrl-C.
[[nodiscard]] std::function<bool(std::size_t done, std::size_t total)> make_progress(
    const std::string& label, const CommonOptions& options);

/// True once SIGINT or SIGTERM has arrived; install_interrupt_handler() must have run.
[[nodiscard]] bool interrupted();
void install_interrupt_handler();

/// Thrown after Ctrl-C once everything is saved; what() tells the user how to go on. The program
/// prints it and exits with 130.
class Interrupted : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What the user typed, quoted so that a shell reads it back; main() sets it.
void set_command_line(int argc, const char* const* argv);
[[nodiscard]] const std::string& command_line();
/// `word` as a shell needs it: in quotes where it holds more than letters, digits and ./:,#=_-
[[nodiscard]] std::string shell_word(const std::string& word);

/// Largest resident memory of this process so far, 10^6 bytes.
[[nodiscard]] double peak_memory_mb();

/// Each adds one subcommand; its callback does the work and throws on errors.
void add_assemble(CLI::App& program);
void add_benchmark(CLI::App& program);
void add_collide(CLI::App& program);
void add_decompose(CLI::App& program);
void add_dock(CLI::App& program);
void add_evaluate(CLI::App& program);
void add_export(CLI::App& program);
void add_info(CLI::App& program);
void add_mate(CLI::App& program);
void add_report(CLI::App& program);
void add_rescore(CLI::App& program);
void add_rotations(CLI::App& program);
void add_sum(CLI::App& program);
void add_sweep(CLI::App& program);

}  // namespace mortise::app
