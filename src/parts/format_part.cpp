// SPDX-License-Identifier: GPL-3.0-or-later
// STL, PLY, OFF and OBJ bytes by hand, STEP bytes by the STEP module.
#include "mortise/parts/format_part.hpp"

#include <Eigen/Geometry>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

#include "mortise/core/errors.hpp"
#include "parts/step/load_kernel.hpp"

namespace mortise {
namespace {

static_assert(std::endian::native == std::endian::little, "STL and PLY bytes are little-endian");

template <class Number>
void put(std::string& bytes, Number value) {
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  bytes.append(raw, sizeof value);
}

void put_single(std::string& bytes, const Eigen::Vector3d& v) {
  for (int i = 0; i < 3; ++i) put(bytes, static_cast<float>(v(i)));
}

// Three numbers with blanks between them.
template <class Vector>
void put_line(std::string& text, const char* head, const Vector& v) {
  text += head;
  for (int i = 0; i < 3; ++i) {
    char number[32];
    const auto end = std::to_chars(number, number + sizeof number, v(i)).ptr;
    text.append(number, end);
    text += i < 2 ? ' ' : '\n';
  }
}

TriangleMesh moved(const TriangleMesh& mesh, const RigidMotion& motion) {
  TriangleMesh result = mesh;
  result.vertices = motion * mesh.vertices;
  return result;
}

}  // namespace

std::string format_stl(const TriangleMesh& mesh, const RigidMotion& motion) {
  if (mesh.size() > std::numeric_limits<std::uint32_t>::max())
    throw InputError("format_stl: an STL file holds at most 4294967295 triangles, got " +
                     std::to_string(mesh.size()));
  const Eigen::Matrix3Xd points = motion * mesh.vertices;
  if (!(points.size() == 0 ||
        points.cwiseAbs().maxCoeff() <= static_cast<double>(std::numeric_limits<float>::max())))
    throw InputError("format_stl: a coordinate does not fit into single precision");
  std::string bytes = "binary STL by Mortise";  // must not begin with "solid"
  bytes.reserve(84 + 50 * static_cast<std::size_t>(mesh.size()));
  bytes.resize(80, ' ');
  put(bytes, static_cast<std::uint32_t>(mesh.size()));
  for (const auto t : mesh.triangles.colwise()) {
    const Eigen::Vector3d a = points.col(t(0));
    const Eigen::Vector3d b = points.col(t(1));
    const Eigen::Vector3d c = points.col(t(2));
    put_single(bytes, (b - a).cross(c - a).stableNormalized());
    put_single(bytes, a);
    put_single(bytes, b);
    put_single(bytes, c);
    put(bytes, std::uint16_t{0});
  }
  return bytes;
}

std::string format_ply(const TriangleMesh& mesh, const RigidMotion& motion) {
  const Eigen::Matrix3Xd points = motion * mesh.vertices;
  std::string bytes = "ply\nformat binary_little_endian 1.0\ncomment by Mortise\nelement vertex " +
                      std::to_string(points.cols()) +
                      "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
                      std::to_string(mesh.size()) +
                      "\nproperty list uchar int vertex_indices\nend_header\n";
  bytes.reserve(bytes.size() + 24 * static_cast<std::size_t>(points.cols()) +
                13 * static_cast<std::size_t>(mesh.size()));
  for (const auto p : points.colwise()) {
    for (int i = 0; i < 3; ++i) put(bytes, p(i));
  }
  for (const auto t : mesh.triangles.colwise()) {
    put(bytes, std::uint8_t{3});
    for (int i = 0; i < 3; ++i) put(bytes, static_cast<std::int32_t>(t(i)));
  }
  return bytes;
}

std::string format_off(const TriangleMesh& mesh) {
  std::string text =
      "OFF\n" + std::to_string(mesh.vertices.cols()) + ' ' + std::to_string(mesh.size()) + " 0\n";
  for (const auto p : mesh.vertices.colwise()) put_line(text, "", p);
  for (const auto t : mesh.triangles.colwise()) put_line(text, "3 ", t);
  return text;
}

std::string format_obj(const TriangleMesh& mesh) {
  std::string text = "# by Mortise\n";
  for (const auto p : mesh.vertices.colwise()) put_line(text, "v ", p);
  for (const auto t : mesh.triangles.colwise())
    put_line(text, "f ", Eigen::Vector3i(t.array() + 1));
  return text;
}

std::string format_step(const TriangleMesh& mesh, const RigidMotion& motion,
                        const std::string& unit) {
  if (mesh.size() > kMostStepTriangles)
    throw InputError("format_step: expected at most " + std::to_string(kMostStepTriangles) +
                     " triangles, found " + std::to_string(mesh.size()) +
                     "; write STL or PLY instead");
  return load_step_kernel().faceted(moved(mesh, motion), unit);
}

std::string format_moved_step(const std::string& path, const RigidMotion& motion) {
  return load_step_kernel().moved(path, motion);
}

}  // namespace mortise
