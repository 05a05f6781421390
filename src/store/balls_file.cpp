// SPDX-License-Identifier: GPL-3.0-or-later
// Plain balls as text.
#include "mortise/store/balls_file.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <vector>

#include "mortise/core/errors.hpp"
#include "mortise/store/atomic_file.hpp"
#include "mortise/store/csv.hpp"
#include "mortise/store/knots_file.hpp"

namespace mortise {
namespace {

constexpr std::string_view kBlanks = " \t\r\v\f";
constexpr std::array<const char*, 5> kFields = {"x", "y", "z", "radius", "weight"};

std::vector<std::string_view> fields_of(std::string_view line) {
  std::vector<std::string_view> fields;
  for (std::size_t at = line.find_first_not_of(kBlanks); at != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(kBlanks, at), line.size());
    fields.push_back(line.substr(at, end - at));
    at = line.find_first_not_of(kBlanks, end);
  }
  return fields;
}

// What stands in the file, short and printable: it may be anything.
std::string quoted(std::string_view text) {
  std::string result = "'";
  for (const char c : text.substr(0, 40))
    result += std::isprint(static_cast<unsigned char>(c)) != 0 ? c : '?';
  return result + (text.size() > 40 ? "...'" : "'");
}

double number(std::string_view text, const char* field, const std::string& path, long line) {
  // from_chars knows no locale, no hexadecimal and no leading plus sign.
  const std::string_view digits = text.starts_with('+') ? text.substr(1) : text;
  const char* end = digits.data() + digits.size();
  double value = 0.0;
  const auto [stop, error] = std::from_chars(digits.data(), end, value);
  // "+-1" is no number, though its rest is.
  const bool twice_signed = text.starts_with('+') && digits.starts_with('-');
  if (error != std::errc() || stop != end || twice_signed || !std::isfinite(value))
    throw FileError(path, line,
                    std::string(field) + ": expected a finite number, found " + quoted(text));
  return value;
}

}  // namespace

Knots parse_xyzr(const std::string& path, std::string_view text) {
  std::vector<std::array<double, 5>> balls;
  long line = 1;
  for (std::size_t at = 0; at < text.size(); ++line) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    std::string_view content = text.substr(at, end - at);
    at = end + 1;
    content = content.substr(0, content.find('#'));
    const std::vector<std::string_view> fields = fields_of(content);
    if (fields.empty()) continue;
    if (fields.size() != 4 && fields.size() != 5)
      throw FileError(path, line,
                      "expected a ball, x y z r or x y z r weight, found " +
                          std::to_string(fields.size()) +
                          (fields.size() == 1 ? " field: " : " fields: ") + quoted(content));
    std::array<double, 5> ball{0.0, 0.0, 0.0, 0.0, 1.0};
    for (std::size_t i = 0; i < fields.size(); ++i)
      ball[i] = number(fields[i], kFields[i], path, line);
    if (!(ball[3] > 0.0))
      throw FileError(path, line, "radius: expected a number > 0, found " + quoted(fields[3]));
    balls.push_back(ball);
  }
  if (balls.empty())
    throw FileError(path, "expected at least one ball, x y z r or x y z r weight a line, found " +
                              std::string(text.empty() ? "an empty file" : "none"));
  const auto count = static_cast<Eigen::Index>(balls.size());
  Knots knots{Eigen::Matrix4Xd(4, count), Eigen::VectorXcd(count)};
  for (Eigen::Index i = 0; i < count; ++i) {
    const std::array<double, 5>& ball = balls[static_cast<std::size_t>(i)];
    knots.points.col(i) << ball[0], ball[1], ball[2], ball[3];
    knots.weights[i] = ball[4];
  }
  return knots;
}

std::string format_xyzr(const Knots& knots) {
  check_knots(knots, "format_xyzr");
  if (!(knots.weights.imag().array() == 0.0).all())
    throw InputError("format_xyzr: expected real weights, found one with an imaginary part");
  const bool weighted = !(knots.weights.real().array() == 1.0).all();
  std::string text = "# Mortise: balls of one body, in its own frame and length unit\n# x y z r";
  text += weighted ? " weight\n" : "\n";
  for (Eigen::Index i = 0; i < knots.size(); ++i) {
    for (Eigen::Index k = 0; k < 4; ++k) {
      if (k > 0) text += ' ';
      text += shortest(knots.points(k, i));
    }
    if (weighted) text += ' ' + shortest(knots.weights[i].real());
    text += '\n';
  }
  return text;
}

Knots read_balls(const std::string& path) {
  if (stored_kind(path) != StoredKind::kNotHdf5) return read_knots_file(path).knots;
  return parse_xyzr(path, read_whole_file(path));
}

bool is_balls_file(const std::string& path) {
  return stored_kind(path) != StoredKind::kNotHdf5 || named_xyzr(path);
}

bool named_xyzr(const std::string& path) {
  std::string name = path;
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return name.ends_with(".xyzr");
}

void write_xyzr(const std::string& path, const Knots& knots) {
  write_file_atomically(path, format_xyzr(knots));
}

}  // namespace mortise
