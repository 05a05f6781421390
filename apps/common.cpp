// SPDX-License-Identifier: GPL-3.0-or-later
// Common options, the progress bar, Ctrl-C, the command line and the memory used.
#include <sys/resource.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <deque>
#include <memory>

#include "clock.hpp"
#include "commands.hpp"
#include "interrupt.hpp"

namespace mortise::app {
namespace {

volatile std::sig_atomic_t interrupt_flag = 0;

void on_signal(int) { interrupt_flag = 1; }

std::atomic<const std::string*> last_words = nullptr;

void exit_on_signal(int) {  // calls only what a signal handler may
  const std::string* words = last_words;
  if (write(STDERR_FILENO, words->data(), words->size()) < 0) _exit(130);
  _exit(130);
}

void handle_interrupts(void (*handler)(int), int flags) {
  struct sigaction action = {};
  action.sa_handler = handler;
  action.sa_flags = flags;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

std::string clock_text(double seconds) {
  char text[32];
  const long s = std::lround(seconds);
  if (s >= 3600)
    std::snprintf(text, sizeof text, "%ld:%02ld:%02ld", s / 3600, s / 60 % 60, s % 60);
  else
    std::snprintf(text, sizeof text, "%ld:%02ld", s / 60, s % 60);
  return text;
}

std::string& command_line_text() {
  static std::string text;
  return text;
}

}  // namespace

void set_command_line(int argc, const char* const* argv) {
  command_line_text() = "mortise";
  for (int i = 1; i < argc; ++i) command_line_text() += " " + shell_word(argv[i]);
}

const std::string& command_line() { return command_line_text(); }

std::string shell_word(const std::string& word) {
  const char* plain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789./:,#=_-+@%";
  if (!word.empty() && word.front() != '#' && word.find_first_not_of(plain) == std::string::npos)
    return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

double peak_memory_mb() {
  rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) * 1024.0 / 1e6;  // Linux counts in KiB
}

void install_interrupt_handler() {
  // A second Ctrl-C ends the program at once.
  handle_interrupts(on_signal, static_cast<int>(SA_RESETHAND));
}

void exit_at_once_on_interrupt(const std::string& message) {
  static std::deque<std::string> all;  // never moved: a signal may be reading one
  last_words = &all.emplace_back("mortise: interrupted: " + message + "\n");
  handle_interrupts(exit_on_signal, 0);
}

bool interrupted() { return interrupt_flag != 0; }

void add_common_options(CLI::App& command, CommonOptions& options, const std::string& examples) {
  command
      .add_option("--threads", options.threads,
                  "Threads to use; 0 = all cores; never changes the result")
      ->capture_default_str()
      ->check(CLI::NonNegativeNumber)
      ->group("Common");
  command.add_flag("--quiet", options.quiet, "No progress, no warnings, no table")->group("Common");
  command
      .add_flag("--json", options.json, "Print one JSON object with the run's figures to stdout")
      ->group("Common");
  command.footer("Examples:\n" + examples);
}

std::function<bool(std::size_t, std::size_t)> make_progress(const std::string& label,
                                                            const CommonOptions& options) {
  if (options.quiet || isatty(STDERR_FILENO) == 0)
    return [](std::size_t, std::size_t) { return !interrupted(); };
  struct State {
    Clock::time_point start = Clock::now(), last = start - std::chrono::seconds(1);
  };
  auto state = std::make_shared<State>();
  return [state, label](std::size_t done, std::size_t total) {
    const auto now = Clock::now();
    const bool finished = done >= total;
    if (finished || now - state->last > std::chrono::milliseconds(100)) {
      state->last = now;
      const double elapsed = std::chrono::duration<double>(now - state->start).count();
      const double fraction =
          total > 0 ? static_cast<double>(done) / static_cast<double>(total) : 1.0;
      const double rate = elapsed > 0 ? static_cast<double>(done) / elapsed : 0.0;
      const double left = rate > 0 ? static_cast<double>(total - done) / rate : 0.0;
      std::string bar(30, '.');
      for (std::size_t i = 0; i < bar.size() && static_cast<double>(i) < 30 * fraction; ++i)
        bar[i] = '#';
      std::fprintf(stderr, "\r%s [%s] %3.0f%%  %.0f/s  %s left \x1b[K%s", label.c_str(),
                   bar.c_str(), 100 * fraction, rate, clock_text(left).c_str(),
                   finished ? "\n" : "");
      std::fflush(stderr);
    }
    return !interrupted();
  };
}

}  // namespace mortise::app
