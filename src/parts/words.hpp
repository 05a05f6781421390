// SPDX-License-Identifier: GPL-3.0-or-later
// Text cut into words and numbers.
#pragma once

#include <charconv>
#include <string_view>

namespace mortise::parts {

/// Words between blanks, with the line they stand in.
class Words {
 public:
  explicit Words(std::string_view text) : text_(text) {}

  /// The next word, empty at the end; line() is then its line.
  std::string_view next() {
    while (at_ < text_.size() && static_cast<unsigned char>(text_[at_]) <= ' ') {
      line_ += text_[at_] == '\n';
      ++at_;
    }
    const std::size_t first = at_;
    while (at_ < text_.size() && static_cast<unsigned char>(text_[at_]) > ' ') ++at_;
    return text_.substr(first, at_ - first);
  }
  /// The rest of the line.
  std::string_view skip_line() {
    const std::size_t first = at_;
    while (at_ < text_.size() && text_[at_] != '\n') ++at_;
    return text_.substr(first, at_ - first);
  }
  /// Bytes taken so far.
  [[nodiscard]] std::size_t position() const { return at_; }
  [[nodiscard]] long line() const { return line_; }

 private:
  std::string_view text_;
  std::size_t at_ = 0;
  long line_ = 1;
};

/// Whether the whole word is a number; below 1e-308 it becomes 0.
inline bool parse_number(std::string_view word, double& value) {
  const char* first = word.data() + (!word.empty() && word[0] == '+' ? 1 : 0);
  const char* last = word.data() + word.size();
  const auto result = std::from_chars(first, last, value);
  if (result.ec == std::errc::result_out_of_range) value = 0.0;
  return !word.empty() && result.ptr == last && result.ec != std::errc::invalid_argument;
}

/// Whether the whole word is an integer.
inline bool parse_number(std::string_view word, long& value) {
  const char* last = word.data() + word.size();
  const auto result = std::from_chars(word.data(), last, value);
  return !word.empty() && result.ptr == last && result.ec == std::errc();
}

}  // namespace mortise::parts
