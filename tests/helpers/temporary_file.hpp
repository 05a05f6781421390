// SPDX-License-Identifier: GPL-3.0-or-later
// A file that lives as long as its object.
#pragma once

#include <fstream>
#include <string>

#include "helpers/scratch_directory.hpp"

namespace mortise::tests {

class TemporaryFile {
 public:
  TemporaryFile(const std::string& name, const std::string& content) : path_(folder_ / name) {
    std::ofstream(path_, std::ios::binary) << content;
  }

  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  ScratchDirectory folder_;
  std::string path_;
};

}  // namespace mortise::tests
