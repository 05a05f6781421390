// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The errors Mortise throws: whose fault it is, where, what was expected and what was found.
#pragma once

#include <stdexcept>
#include <string>

namespace mortise {

/// The caller or the user gave something Mortise cannot work with.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A file is missing, unreadable or malformed. what() reads "path:line: message" (no line: "path:
/// message").
class FileError : public InputError {
 public:
  FileError(std::string path, const std::string& message)
      : InputError(path + ": " + message), path_(std::move(path)) {}
  FileError(std::string path, long line, const std::string& message)
      : InputError(path + ":" + std::to_string(line) + ": " + message),
        path_(std::move(path)),
        line_(line) {}

  [[nodiscard]] const std::string& path() const noexcept { return path_; }
  [[nodiscard]] long line() const noexcept { return line_; }  ///< 1-based; 0 = the file as a whole

 private:
  std::string path_;
  long line_ = 0;
};

}  // namespace mortise
