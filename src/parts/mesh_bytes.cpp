// SPDX-License-Identifier: GPL-3.0-or-later
// A file's bytes and which format they are.
#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <filesystem>

#include "mortise/core/errors.hpp"
#include "mortise/core/read_file.hpp"
#include "mortise/parts/read_part.hpp"
#include "parts/mesh_files.hpp"

namespace mortise::parts {
namespace {

std::string lower_ending(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return ending;
}

std::string_view without_leading_blanks(std::string_view text) {
  if (text.substr(0, 3) == "\xef\xbb\xbf") text.remove_prefix(3);  // byte order mark
  const auto first = text.find_first_not_of(" \t\r\n\f\v");
  return first == std::string_view::npos ? std::string_view() : text.substr(first);
}

/// Bytes that a binary STL file of that header has, 0 if there is no header.
std::uint64_t binary_stl_size(std::string_view bytes) {
  if (bytes.size() < 84) return 0;
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + 80, sizeof count);
  return 84 + 50 * static_cast<std::uint64_t>(count);
}

bool looks_like_text(std::string_view bytes) {
  const std::string_view head = bytes.substr(0, 4096);
  return std::all_of(head.begin(), head.end(), [](unsigned char c) {
    return c >= 0x20 || c == '\n' || c == '\r' || c == '\t' || c == '\f' || c == '\v';
  });
}

/// Whether the first words of some early line are those of an OBJ file.
bool looks_like_obj(std::string_view bytes) {
  if (!looks_like_text(bytes)) return false;
  std::size_t at = 0;
  for (int line = 0; line < 200 && at < bytes.size(); ++line) {
    const std::size_t end = std::min(bytes.find('\n', at), bytes.size());
    const std::string_view text = without_leading_blanks(bytes.substr(at, end - at));
    for (const std::string_view word :
         {"v ", "v\t", "vn ", "vt ", "mtllib ", "o ", "g ", "usemtl "}) {
      if (text.substr(0, word.size()) == word) return true;
    }
    at = end + 1;
  }
  return false;
}

}  // namespace

std::string read_bytes(const std::string& path) {
  std::string bytes = read_whole_file(path, "a mesh or STEP file");
  if (bytes.empty()) throw FileError(path, "expected a mesh or STEP file, found an empty one");
  return bytes;
}

MeshFormat detect_format(const std::string& path, std::string_view bytes) {
  const std::string_view text = without_leading_blanks(bytes.substr(0, 4096));
  if (text.substr(0, 12) == "ISO-10303-21") return MeshFormat::kStep;
  if (text.substr(0, 4) == "ply\n" || text.substr(0, 4) == "ply\r") return MeshFormat::kPly;
  // Some programs begin binary files with "solid" too: their size tells.
  const std::uint64_t binary_size = binary_stl_size(bytes);
  if (binary_size == bytes.size()) return MeshFormat::kStlBinary;
  const bool solid =
      text.size() >= 5 && std::equal(text.begin(), text.begin() + 5, "solid",
                                     [](unsigned char a, char b) { return std::tolower(a) == b; });
  if (solid && looks_like_text(bytes)) return MeshFormat::kStlAscii;
  const std::string_view first_word = text.substr(0, text.find_first_of(" \t\r\n"));
  if (first_word == "OFF" || first_word == "COFF" || first_word == "NOFF" ||
      first_word == "CNOFF" || first_word == "STOFF")
    return MeshFormat::kOff;
  if (looks_like_obj(bytes)) return MeshFormat::kObj;
  if (lower_ending(path) == ".stl" && !looks_like_text(bytes) && bytes.size() >= 84)
    return MeshFormat::kStlBinary;
  if (bytes.size() < 84 && lower_ending(path) == ".stl")
    throw FileError(path, "expected an STL file, found " + std::to_string(bytes.size()) + " bytes");
  throw FileError(path, "expected STL, OBJ, PLY, OFF or STEP, found " +
                            std::string(looks_like_text(bytes) ? "other text" : "other bytes"));
}

}  // namespace mortise::parts

namespace mortise {

bool is_step_file(const std::string& path) {
  return parts::detect_format(path, parts::read_bytes(path)) == parts::MeshFormat::kStep;
}

}  // namespace mortise
