// SPDX-License-Identifier: GPL-3.0-or-later
// Readers of mesh formats: bytes in, triangles as they stand in the file out.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "mortise/parts/triangle_mesh.hpp"

namespace mortise::parts {

enum class MeshFormat { kStlAscii, kStlBinary, kObj, kPly, kOff, kStep };

/// What the content is, whatever the name; @throws FileError if it is none of them.
[[nodiscard]] MeshFormat detect_format(const std::string& path, std::string_view bytes);

/// The whole file. @throws FileError if it is missing, a directory, unreadable or empty
[[nodiscard]] std::string read_bytes(const std::string& path);

/// @throws FileError if the file is cut off or malformed; a note is a line for the user
[[nodiscard]] TriangleMesh read_stl_ascii(const std::string& path, std::string_view bytes);
[[nodiscard]] TriangleMesh read_stl_binary(const std::string& path, std::string_view bytes,
                                           std::vector<std::string>& notes);

/// Faces of three or more corners that share their points.
struct PolygonSoup {
  std::vector<Eigen::Vector3d> points;
  std::vector<std::vector<std::size_t>> polygons;
};

[[nodiscard]] PolygonSoup read_obj(const std::string& path, std::string_view bytes);
[[nodiscard]] PolygonSoup read_off(const std::string& path, std::string_view bytes);
[[nodiscard]] PolygonSoup read_ply(const std::string& path, std::string_view bytes);

/// @throws FileError if there is no face, an index is out of range or a point in use is not finite
[[nodiscard]] TriangleMesh triangulate(const std::string& path, const PolygonSoup& soup,
                                       std::vector<std::string>& notes);

}  // namespace mortise::parts
