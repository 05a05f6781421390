// SPDX-License-Identifier: GPL-3.0-or-later
// Reads a file, pipes included.
#include "mortise/core/read_file.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <vector>

#include "mortise/core/errors.hpp"

namespace mortise {

std::string read_whole_file(const std::string& path, const std::string& expected) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found)
    throw FileError(path, "expected " + expected + ", found none");
  if (status.type() == std::filesystem::file_type::none)  // a folder on the way is closed to us
    throw FileError(path, "cannot be opened: " + error.message());
  if (std::filesystem::is_directory(status))
    throw FileError(path, "expected " + expected + ", found a directory");
  std::ifstream file(path, std::ios::binary);
  if (!file) throw FileError(path, std::string("cannot be opened: ") + std::strerror(errno));
  std::string bytes;
  const auto size = std::filesystem::file_size(path, error);
  if (!error) bytes.reserve(size);
  std::vector<char> buffer(1 << 16);
  while (file.read(buffer.data(), static_cast<std::streamsize>(buffer.size())) || file.gcount() > 0)
    bytes.append(buffer.data(), static_cast<std::size_t>(file.gcount()));
  if (file.bad()) throw FileError(path, std::string("cannot be read: ") + std::strerror(errno));
  return bytes;
}

}  // namespace mortise
