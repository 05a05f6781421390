// SPDX-License-Identifier: GPL-3.0-or-later
// Hybrid-36 encoding and decoding.
#include "molecules/hybrid36.hpp"

#include <charconv>

namespace mortise::molecules {
namespace {

struct Range {
  int decimal_end;    ///< 10^width
  int letters;        ///< 26 * 36^(width - 1), the numbers that start with a letter
  int digits_before;  ///< 10 * 36^(width - 1), the base-36 value of "A00..."
};

Range range_of(std::size_t width) {
  int power = 1, decimal = 10;
  for (std::size_t i = 1; i < width; ++i) {
    power *= 36;
    decimal *= 10;
  }
  return {decimal, 26 * power, 10 * power};
}

bool within(char c, char low, char high) { return c >= low && c <= high; }

}  // namespace

std::optional<int> decode_hybrid36(std::string_view field, std::size_t width) {
  if (field.empty()) return {};
  const char* end = field.data() + field.size();
  int value = 0;
  const bool upper = within(field[0], 'A', 'Z'), lower = within(field[0], 'a', 'z');
  if (!upper && !lower) {
    const auto [stop, error] = std::from_chars(field.data(), end, value);
    if (error != std::errc() || stop != end) return {};
    return value;
  }
  if (field.size() != width) return {};
  for (const char c : field)
    if (!within(c, '0', '9') && !(upper ? within(c, 'A', 'Z') : within(c, 'a', 'z'))) return {};
  const auto [stop, error] = std::from_chars(field.data(), end, value, 36);
  if (error != std::errc() || stop != end) return {};
  const Range range = range_of(width);
  return value - range.digits_before + range.decimal_end + (lower ? range.letters : 0);
}

std::optional<std::string> encode_hybrid36(int number, std::size_t width) {
  const Range range = range_of(width);
  std::string text;
  if (number < range.decimal_end) {
    text = std::to_string(number);
    if (text.size() > width) return {};
    return std::string(width - text.size(), ' ') + text;
  }
  int rest = number - range.decimal_end;
  const bool lower = rest >= range.letters;
  if (lower) rest -= range.letters;
  if (rest >= range.letters) return {};
  rest += range.digits_before;
  for (std::size_t i = 0; i < width; ++i, rest /= 36) {
    const int digit = rest % 36;
    text.insert(text.begin(),
                static_cast<char>(digit < 10 ? '0' + digit : (lower ? 'a' : 'A') + digit - 10));
  }
  return text;
}

}  // namespace mortise::molecules
