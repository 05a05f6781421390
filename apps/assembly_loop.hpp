// SPDX-License-Identifier: GPL-3.0-or-later
// Wrenches along a path in real time, how long each took, and both as files.
#pragma once

#include <string>
#include <vector>

#include "mortise/assembly/assembly_session.hpp"

namespace mortise::app {

// Quantiles of times in microseconds.
struct Latency {
  double median = 0.0, percentile_99 = 0.0, percentile_999 = 0.0, largest = 0.0;
  std::size_t steps = 0;
};

[[nodiscard]] Latency latency(std::vector<double> times);

struct Loop {
  std::vector<Wrench> wrenches;
  std::vector<double> compute,
      late;                  // microseconds: of the wrench; of the step's end after its start
  std::vector<double> felt;  // `compute` where the parts were in reach of each other
  int misses = 0;            // steps that ended after the next was due
};

/// The wrench at every pose of `path`, one each 1 / rate seconds.
/// @throws Interrupted on Ctrl-C
[[nodiscard]] Loop run_loop(const AssemblySession& session, const std::vector<RigidMotion>& path,
                            double rate);

/// CSV: time, energy, force, torque, microseconds.
void write_wrenches(const std::string& file_name, const Loop& loop, double rate);

/// The same against time as a picture [HA, Fig. 8].
void write_plot(const std::string& file_name, const Loop& loop, double rate);

/// @throws Interrupted if Ctrl-C was pressed
void stop_if_interrupted(const char* what_is_lost);

}  // namespace mortise::app
