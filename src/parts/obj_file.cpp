// SPDX-License-Identifier: GPL-3.0-or-later
// OBJ files: points and faces; whatever else stands there is passed over.
#include <algorithm>
#include <limits>

#include "mortise/core/errors.hpp"
#include "parts/mesh_files.hpp"
#include "parts/words.hpp"

namespace mortise::parts {
namespace {

/// One statement after the other: without comments, lines that end in a backslash joined.
class Statements {
 public:
  explicit Statements(std::string_view bytes) : rest_(bytes) {}

  /// The next one that is not empty; false at the end. line() is where it begins.
  bool next(std::string& statement) {
    do {
      if (rest_.empty()) return false;
      line_ = next_line_;
      statement.clear();
      bool goes_on = true;
      while (goes_on && !rest_.empty()) {
        const std::size_t end = std::min(rest_.find('\n'), rest_.size());
        std::string_view text = rest_.substr(0, end);
        rest_.remove_prefix(std::min(end + 1, rest_.size()));
        ++next_line_;
        text = text.substr(0, text.find('#'));
        const std::size_t last = text.find_last_not_of(" \t\r");
        text = text.substr(0, last == std::string_view::npos ? 0 : last + 1);
        goes_on = !text.empty() && text.back() == '\\';
        if (goes_on) text.remove_suffix(1);
        statement.append(text).push_back(' ');
      }
    } while (statement.find_first_not_of(" \t") == std::string::npos);
    return true;
  }
  [[nodiscard]] long line() const { return line_; }

 private:
  std::string_view rest_;
  long line_ = 0;
  long next_line_ = 1;
};

}  // namespace

PolygonSoup read_obj(const std::string& path, std::string_view bytes) {
  PolygonSoup soup;
  Statements statements(bytes);
  std::string statement;
  while (statements.next(statement)) {
    Words words(statement);
    const std::string_view kind = words.next();
    if (kind == "v") {
      Eigen::Vector3d point;
      for (double& x : point) {
        const std::string_view word = words.next();
        if (!parse_number(word, x))
          throw FileError(path, statements.line(),
                          "expected three coordinates after v, found \"" +
                              std::string(word.substr(0, 40)) + "\"");
      }
      soup.points.push_back(point);
    } else if (kind == "f" || kind == "fo") {
      std::vector<std::size_t>& corners = soup.polygons.emplace_back();
      for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
        long index = 0;
        const long count = static_cast<long>(soup.points.size());
        if (!parse_number(word.substr(0, word.find('/')), index) || index == 0 || index < -count)
          throw FileError(path, statements.line(),
                          "expected corners like 1, 1/2, 1//3 or -1 after f, found \"" +
                              std::string(word.substr(0, 40)) + "\"");
        // Points may follow their faces; triangulate() refuses those that never come.
        corners.push_back(static_cast<std::size_t>(index > 0 ? index - 1 : count + index));
      }
    }
  }
  return soup;
}

}  // namespace mortise::parts
