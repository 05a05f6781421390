// SPDX-License-Identifier: GPL-3.0-or-later
// Whole text files, plain or gzip, and what kind of text they hold.
#include <algorithm>
#include <boost/iostreams/copy.hpp>
#include <boost/iostreams/device/array.hpp>
#include <boost/iostreams/device/back_inserter.hpp>
#include <boost/iostreams/filter/gzip.hpp>
#include <boost/iostreams/filtering_streambuf.hpp>
#include <cctype>
#include <charconv>
#include <cmath>

#include "molecules/atom_records.hpp"
#include "mortise/core/errors.hpp"
#include "mortise/core/read_file.hpp"

namespace mortise::molecules {
namespace {

bool is_gzip(std::string_view text) {
  return text.size() >= 2 && text[0] == '\x1f' && text[1] == '\x8b';
}

std::string unpack(const std::string& path, const std::string& packed) {
  namespace io = boost::iostreams;
  std::string text;
  try {
    io::filtering_streambuf<io::input> in;
    in.push(io::gzip_decompressor());
    in.push(io::array_source(packed.data(), packed.size()));
    io::copy(in, io::back_inserter(text));
  } catch (const io::gzip_error&) {
    throw FileError(path, "expected gzip data, found it damaged or cut off after " +
                              std::to_string(text.size()) + " unpacked bytes");
  } catch (const std::exception& e) {
    throw FileError(path, std::string("cannot unpack gzip data: ") + e.what());
  }
  return text;
}

bool starts_with_ignoring_case(std::string_view text, std::string_view lower) {
  return text.size() >= lower.size() &&
         std::equal(lower.begin(), lower.end(), text.begin(), [](char a, char b) {
           return a == std::tolower(static_cast<unsigned char>(b));
         });
}

}  // namespace

std::string_view trim(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::string read_text(const std::string& path) {
  std::string text = read_whole_file(path, "a structure file");
  if (text.empty()) throw FileError(path, "expected a structure, found an empty file");
  if (is_gzip(text)) {
    text = unpack(path, text);
    if (text.empty()) throw FileError(path, "expected a structure, found nothing once unpacked");
  } else if (path.size() > 3 && path.ends_with(".gz")) {
    throw FileError(path, "expected gzip data after its name, found something else");
  }
  return text;
}

Format detect_format(const std::string& path, std::string_view text) {
  const std::string expected = "expected a PDB or mmCIF file, found ";
  const std::string_view head = text.substr(0, 4096);
  const auto odd = std::count_if(head.begin(), head.end(), [](unsigned char c) {
    return c == 0x7f || (c < 0x20 && c != '\n' && c != '\r' && c != '\t' && c != '\f');
  });
  if (head.find('\0') != std::string_view::npos || odd * 20 > static_cast<long>(head.size()))
    throw FileError(path, expected + "binary data");
  long line = 1;
  bool first_line = true;
  for (std::size_t at = 0; at < text.size(); ++line) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string_view content = trim(text.substr(at, end - at));
    at = end + 1;
    if (content.empty()) continue;
    if (first_line && content.front() == '<') {
      const bool xml = starts_with_ignoring_case(content, "<?xml") &&
                       text.substr(0, 4096).find("<html") == std::string_view::npos;
      throw FileError(path, line,
                      expected + (xml ? "XML" : "an HTML page (a download that failed?)"));
    }
    first_line = false;
    if (starts_with_ignoring_case(content, "data_")) return Format::kMmcif;
    if (content.front() != '#') return Format::kPdb;
  }
  return Format::kPdb;
}

double parse_coordinate(std::string_view text, char axis, const std::string& path, long line) {
  const std::string_view bare = trim(text);
  const auto refuse = [&](const std::string& expected) {
    throw FileError(path, line,
                    std::string(1, axis) + " coordinate: expected " + expected + ", found '" +
                        std::string(bare) + "'");
  };
  // from_chars knows no locale, no hexadecimal and no leading plus sign.
  const std::string_view digits = bare.starts_with('+') ? bare.substr(1) : bare;
  const char* end = digits.data() + digits.size();
  double value = 0.0;
  const auto [stop, error] = std::from_chars(digits.data(), end, value);
  if (error == std::errc::invalid_argument || stop != end) refuse("a number");
  // 9999.000 is how some programs write an unknown position.
  if (error != std::errc() || !(std::abs(value) < 9999.0))
    refuse("a finite number below 9999 in size");
  return value;
}

}  // namespace mortise::molecules
