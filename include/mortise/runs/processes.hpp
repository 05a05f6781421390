// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Independent jobs in processes of their own: what befalls one spares the others.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace mortise {

/// What became of one job.
struct JobResult {
  std::string text;      ///< what the job returned; empty if it did not end by returning
  std::string failure;   ///< "ended by signal 9"; empty if it returned
  bool stopped = false;  ///< the job threw JobStopped, or was told to end
  double cpu_seconds = 0.0;
  double peak_memory_mb = 0.0;  ///< 10^6 bytes
};

/// Thrown by a job that was asked to end early.
struct JobStopped {};

struct JobHooks {
  /// In a process of its own: does job `index` and returns its result as text, of at most 60 kB.
  std::function<std::string(std::size_t index)> work;
  std::function<void(std::size_t index, const JobResult& result)> done;  ///< here, as each ends
  std::function<bool()> stop = {};  ///< true: no further job is begun, those at work get SIGTERM
};

/// Does `count` jobs in the order of their numbers, at most `at_once` at a time. Returns when all
/// that were begun have ended. A job's process ends with this one.
///
/// No other child process may end meanwhile, and no other thread be at work.
/// @throws std::runtime_error if no process can be made
void run_in_processes(std::size_t count, int at_once, const JobHooks& hooks);

}  // namespace mortise
