// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Finding a run's two input files again and making sure that they are still what they were.
#pragma once

#include <string>

#include "mortise/store/run_file.hpp"

namespace mortise {

struct LocateOptions {
  std::string path;    ///< look here instead of where the run says; empty = as recorded
  bool force = false;  ///< accept a file whose checksum differs
};

/// The path of a body's file, verified by SHA-256.
///
/// A relative path is tried from the run's working directory, then from the present one.
/// @param name  "fixed" or "moving", for messages
/// @throws FileError if there is no such file, or its contents have changed since the run
[[nodiscard]] std::string locate_input(const BodyRecord& body, const Provenance& provenance,
                                       const std::string& name, const LocateOptions& options = {});

}  // namespace mortise
