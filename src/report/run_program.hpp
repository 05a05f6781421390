// SPDX-License-Identifier: GPL-3.0-or-later
// Running another program and keeping what it says.
#pragma once

#include <string>
#include <vector>

namespace mortise::detail {

// Runs `words` (found on the PATH) without a shell and without input, and waits. `settings` are
// added to the environment as NAME=value.
// Throws InputError with `hint` if it cannot be started, with the end of its output if it fails.
void run_program(const std::vector<std::string>& words, const std::vector<std::string>& settings,
                 const std::string& hint);

// A directory of its own below the system's temporary one, removed with all in it at the end.
class TemporaryDirectory {
 public:
  TemporaryDirectory();
  ~TemporaryDirectory();
  TemporaryDirectory(const TemporaryDirectory&) = delete;
  TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;
  [[nodiscard]] std::string operator/(const std::string& name) const { return path_ + "/" + name; }

 private:
  std::string path_;
};

}  // namespace mortise::detail
