// SPDX-License-Identifier: GPL-3.0-or-later
// The real-time loop of an assembly.
#include "assembly_loop.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <iomanip>
#include <sstream>

#include "commands.hpp"
#include "line_plot.hpp"
#include "mortise/store/atomic_file.hpp"

namespace mortise::app {
namespace {

double now() {
  timespec t = {};
  clock_gettime(CLOCK_MONOTONIC, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

// Sleeps until shortly before, then watches the clock: the system wakes sleepers late. Ctrl-C ends
// it: the signal may be another thread's, so no sleep is long.
void wait_until(double time) {
  constexpr double kWatch = 2e-4, kLongest = 0.1;
  for (double left = time - kWatch - now(); left > 0.0 && !interrupted();
       left = time - kWatch - now()) {
    const double sleep = now() + std::min(left, kLongest);
    const timespec until = {static_cast<time_t>(sleep),
                            static_cast<long>((sleep - std::floor(sleep)) * 1e9)};
    clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr);
  }
  while (now() < time && !interrupted()) {
  }
}

// Out of reach nothing is summed and all is zero.
bool in_reach(const Wrench& w) {
  return w.energy != 0.0 || !w.force.isZero(0.0) || !w.torque.isZero(0.0);
}

}  // namespace

void stop_if_interrupted(const char* what_is_lost) {
  if (interrupted()) throw Interrupted(what_is_lost);
}

Latency latency(std::vector<double> times) {
  if (times.empty()) return {};
  std::sort(times.begin(), times.end());
  const auto at = [&](double share) {
    return times[std::min(times.size() - 1,
                          static_cast<std::size_t>(share * static_cast<double>(times.size())))];
  };
  return {at(0.5), at(0.99), at(0.999), times.back(), times.size()};
}

Loop run_loop(const AssemblySession& session, const std::vector<RigidMotion>& path, double rate) {
  Loop loop;
  loop.wrenches.resize(path.size());
  loop.compute.resize(path.size());
  loop.late.resize(path.size());
  loop.felt.reserve(path.size());
  const double period = 1.0 / rate, start = now() + 0.01;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const double due = start + static_cast<double>(i) * period;
    wait_until(due);
    stop_if_interrupted("the path was not followed to its end");
    const double begun = now();
    loop.wrenches[i] = session.wrench(path[i]);
    const double ended = now();
    loop.compute[i] = 1e6 * (ended - begun);
    loop.late[i] = 1e6 * (ended - due);
    if (ended > due + period) ++loop.misses;
    if (in_reach(loop.wrenches[i])) loop.felt.push_back(loop.compute[i]);
  }
  return loop;
}

void write_wrenches(const std::string& file_name, const Loop& loop, double rate) {
  std::ostringstream file;
  file << "time,energy,fx,fy,fz,tx,ty,tz,microseconds\n" << std::setprecision(9);
  for (std::size_t i = 0; i < loop.wrenches.size(); ++i) {
    const Wrench& w = loop.wrenches[i];
    file << static_cast<double>(i) / rate << ',' << w.energy;
    for (int d = 0; d < 3; ++d) file << ',' << w.force[d];
    for (int d = 0; d < 3; ++d) file << ',' << w.torque[d];
    file << ',' << loop.compute[i] << '\n';
  }
  write_file_atomically(file_name, file.str());
}

void write_plot(const std::string& file_name, const Loop& loop, double rate) {
  std::vector<double> time, energy, force[3], torque[3];
  for (std::size_t i = 0; i < loop.wrenches.size(); ++i) {
    const Wrench& w = loop.wrenches[i];
    time.push_back(static_cast<double>(i) / rate);
    energy.push_back(w.energy);
    for (int d = 0; d < 3; ++d) {
      force[d].push_back(w.force[d]);
      torque[d].push_back(w.torque[d]);
    }
  }
  write_line_plot(file_name, "time (s)", time,
                  {{"energy", {{"E", energy}}},
                   {"force", {{"x", force[0]}, {"y", force[1]}, {"z", force[2]}}},
                   {"torque", {{"x", torque[0]}, {"y", torque[1]}, {"z", torque[2]}}},
                   {"time per step (us)", {{"", loop.compute}}}});
}

}  // namespace mortise::app
