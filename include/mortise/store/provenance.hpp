// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Where a file of results comes from: program, command, options, time, inputs.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace mortise {

/// A measured number under its name, such as seconds_search.
struct Figure {
  std::string name;
  double value = 0.0;
};

/// How a result was made; written to the root attributes of every HDF5 file.
struct Provenance {
  std::string mortise_version;
  std::string command_line;
  std::string working_directory;    ///< relative input paths count from here
  std::string options_json = "{}";  ///< the resolved options, one JSON object
  std::uint64_t seed = 0;
  std::string utc_time;  ///< "2026-01-31T12:00:00Z"
  std::string host;
};

/// This build's version, the present directory, utc_now() and the host's name, with what the caller
/// gives.
[[nodiscard]] Provenance make_provenance(const std::string& command_line,
                                         const std::string& options_json = "{}",
                                         std::uint64_t seed = 0);

/// The time as "YYYY-MM-DDThh:mm:ssZ". If SOURCE_DATE_EPOCH is set, that time, so that files are
/// reproducible.
/// @throws InputError if SOURCE_DATE_EPOCH is not a whole number of seconds
[[nodiscard]] std::string utc_now();

/// SHA-256 of a file's bytes, 64 lower-case hex digits. @throws FileError if it cannot be read
[[nodiscard]] std::string sha256_of_file(const std::string& path);

}  // namespace mortise
