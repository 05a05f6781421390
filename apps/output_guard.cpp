// SPDX-License-Identifier: GPL-3.0-or-later
// Checks of output files.
#include "output_guard.hpp"

#include <filesystem>

#include "mortise/core/errors.hpp"
#include "mortise/store/atomic_file.hpp"

namespace mortise::app {

namespace fs = std::filesystem;

bool same_file(const std::string& a, const std::string& b) {
  std::error_code error;
  if (fs::equivalent(a, b, error) && !error) return true;
  const fs::path whole_a = fs::weakly_canonical(fs::absolute(a, error), error);
  if (error) return false;
  const fs::path whole_b = fs::weakly_canonical(fs::absolute(b, error), error);
  return !error && whole_a == whole_b;
}

void refuse_to_overwrite_input(const std::string& output, const std::vector<std::string>& inputs) {
  for (const std::string& input : inputs)
    if (!input.empty() && same_file(output, input))
      throw FileError(output, "expected a file to write, found an input");
}

void check_output_file(const std::string& output, const std::vector<std::string>& inputs,
                       bool may_exist, const std::string& remedy) {
  refuse_to_overwrite_input(output, inputs);
  if (!may_exist && fs::exists(output)) throw FileError(output, "exists already (" + remedy + ")");
  check_writable(output);
}

}  // namespace mortise::app
