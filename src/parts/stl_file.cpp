// SPDX-License-Identifier: GPL-3.0-or-later
// STL files. CGAL's reader puts every corner into a tree of points, which no NaN survives and which
// takes longer than all repairs together; these leave merging to repair_mesh.
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

#include "mortise/core/errors.hpp"
#include "parts/mesh_files.hpp"
#include "parts/words.hpp"

namespace mortise::parts {
namespace {

/// Three corners each, in order.
TriangleMesh soup_of(const std::vector<Eigen::Vector3d>& corners) {
  TriangleMesh mesh;
  const auto count = static_cast<Eigen::Index>(corners.size());
  mesh.vertices.resize(3, count);
  for (Eigen::Index i = 0; i < count; ++i)
    mesh.vertices.col(i) = corners[static_cast<std::size_t>(i)];
  mesh.triangles.resize(3, count / 3);
  for (Eigen::Index i = 0; i < count; ++i) mesh.triangles.data()[i] = static_cast<int>(i);
  return mesh;
}

constexpr std::size_t kMostTriangles = std::numeric_limits<int>::max() / 3;

bool is_word(std::string_view found, std::string_view lower) {
  if (found.size() != lower.size()) return false;
  for (std::size_t i = 0; i < found.size(); ++i) {
    if ((found[i] | 0x20) != lower[i]) return false;
  }
  return true;
}

}  // namespace

TriangleMesh read_stl_ascii(const std::string& path, std::string_view bytes) {
  Words words(bytes);
  std::vector<Eigen::Vector3d> corners;
  bool open_solid = false;
  bool open_facet = false;
  const auto fail = [&](const std::string& expected, std::string_view found) {
    throw FileError(
        path, words.line(),
        "expected " + expected + ", found " +
            (found.empty() ? "the end of the file" : "'" + std::string(found.substr(0, 40)) + "'"));
  };
  for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
    if (is_word(word, "vertex")) {
      if (!open_facet) fail("'facet'", word);
      Eigen::Vector3d p;
      for (int i = 0; i < 3; ++i) {
        const std::string_view number = words.next();
        if (!parse_number(number, p(i))) fail("a coordinate", number);
        if (!std::isfinite(p(i))) fail("a finite coordinate", number);
      }
      corners.push_back(p);
      if (corners.size() / 3 > kMostTriangles) fail("fewer triangles", word);
    } else if (is_word(word, "facet")) {
      if (open_facet) fail("'endfacet'", word);
      open_facet = true;
      words.skip_line();  // the normal follows from the corners
    } else if (is_word(word, "endfacet")) {
      if (!open_facet || corners.size() % 3 != 0) fail("three vertices in a facet", word);
      open_facet = false;
    } else if (is_word(word, "solid")) {
      open_solid = true;
      words.skip_line();
    } else if (is_word(word, "endsolid")) {
      open_solid = false;
      words.skip_line();
    } else if (is_word(word, "color")) {
      words.skip_line();
    } else if (!is_word(word, "outer") && !is_word(word, "loop") && !is_word(word, "endloop")) {
      fail("an STL keyword", word);
    }
  }
  if (open_facet || open_solid) fail("'endsolid'", {});
  if (corners.empty()) throw FileError(path, "expected facets, found an STL file without one");
  return soup_of(corners);
}

TriangleMesh read_stl_binary(const std::string& path, std::string_view bytes,
                             std::vector<std::string>& notes) {
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + 80, sizeof count);
  const std::uint64_t expected = 84 + 50 * static_cast<std::uint64_t>(count);
  if (bytes.size() < expected)
    throw FileError(path, "expected " + std::to_string(expected) + " bytes for " +
                              std::to_string(count) + " triangles, found " +
                              std::to_string(bytes.size()));
  if (count == 0) throw FileError(path, "expected facets, found an STL file without one");
  if (count > kMostTriangles) throw FileError(path, "too many triangles: " + std::to_string(count));
  if (bytes.size() > expected)
    notes.push_back("ignored " + std::to_string(bytes.size() - expected) +
                    " bytes after the last triangle");
  std::vector<Eigen::Vector3d> corners;
  corners.reserve(3 * static_cast<std::size_t>(count));
  for (std::uint32_t i = 0; i < count; ++i) {
    float numbers[9];
    std::memcpy(numbers, bytes.data() + 84 + 50 * static_cast<std::size_t>(i) + 12, sizeof numbers);
    for (int k = 0; k < 3; ++k) {
      corners.emplace_back(numbers[3 * k], numbers[3 * k + 1], numbers[3 * k + 2]);
      if (!corners.back().allFinite())
        throw FileError(path, "triangle " + std::to_string(i) + ": a coordinate is not finite");
    }
  }
  return soup_of(corners);
}

}  // namespace mortise::parts
