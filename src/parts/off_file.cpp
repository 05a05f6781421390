// SPDX-License-Identifier: GPL-3.0-or-later
// OFF files in text. CGAL's reader takes the memory that the header asks for before it looks at the
// rest.
#include <limits>

#include "mortise/core/errors.hpp"
#include "parts/mesh_files.hpp"
#include "parts/words.hpp"

namespace mortise::parts {

PolygonSoup read_off(const std::string& path, std::string_view bytes) {
  Words words(bytes);
  const auto next = [&] {
    std::string_view word = words.next();
    while (!word.empty() && word[0] == '#') {
      words.skip_line();
      word = words.next();
    }
    return word;
  };
  const auto fail = [&](const std::string& expected, std::string_view found) {
    throw FileError(
        path, words.line(),
        "expected an OFF file with " + expected + ", found " +
            (found.empty() ? "the end of the file" : "'" + std::string(found.substr(0, 40)) + "'"));
  };
  const auto integer = [&](const char* what, long most) {
    const std::string_view word = next();
    long value = 0;
    if (!parse_number(word, value) || value < 0 || value > most) fail(what, word);
    return value;
  };
  const std::string_view kind = next();
  if (!kind.ends_with("OFF")) fail("'OFF' at its head", kind);
  // No count can be larger than the file; each number takes two bytes.
  const long most = static_cast<long>(bytes.size() / 2);
  const long vertices = integer("a number of vertices", most);
  const long faces = integer("a number of faces", most);
  (void)integer("a number of edges", std::numeric_limits<long>::max());
  // NOFF has normals, COFF colours after each vertex: to the end of its line, as are face colours.
  const bool more_per_vertex = kind != "OFF";
  PolygonSoup soup;
  for (long i = 0; i < vertices; ++i) {
    Eigen::Vector3d p;
    for (int k = 0; k < 3; ++k) {
      const std::string_view word = next();
      if (!parse_number(word, p(k))) fail("a coordinate", word);
    }
    if (more_per_vertex) words.skip_line();
    soup.points.push_back(p);
  }
  for (long i = 0; i < faces; ++i) {
    const long corners = integer("a number of corners", most);
    auto& polygon = soup.polygons.emplace_back();
    for (long k = 0; k < corners; ++k)
      polygon.push_back(static_cast<std::size_t>(integer("a vertex of it", vertices - 1)));
    words.skip_line();
  }
  return soup;
}

}  // namespace mortise::parts
