// SPDX-License-Identifier: GPL-3.0-or-later
// What the benchmark programs share: CPU time, and errors told in one line.
#pragma once

#include <cstdio>
#include <ctime>
#include <exception>
#include <sstream>
#include <string>
#include <vector>

namespace mortise::bench {

/// CPU time of this process: other work on the machine does not count.
inline double cpu_seconds() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// The fields between the separators.
inline std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> fields;
  std::istringstream stream(text);
  for (std::string field; std::getline(stream, field, separator);) fields.push_back(field);
  return fields;
}

/// main() around run(arguments), which throws what went wrong.
template <class Run>
int bench_main(const char* name, int argc, char** argv, const Run& run) {
  try {
    run(std::vector<std::string>(argv + 1, argv + argc));
    return 0;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s: error: %s\n", name, e.what());
    return 1;
  }
}

}  // namespace mortise::bench
