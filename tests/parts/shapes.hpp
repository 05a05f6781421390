// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Closed meshes made to order for tests and benchmarks: spheres, tori, cubes, noisy spheres.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "mortise/parts/triangle_mesh.hpp"

namespace mortise::shapes {

/// Every triangle into four, new vertices in the middle of the edges; the surface stays as it is.
inline TriangleMesh subdivide(const TriangleMesh& mesh) {
  std::map<std::pair<int, int>, int> middles;
  std::vector<Eigen::Vector3d> points;
  points.reserve(mesh.vertices.cols() * 4);
  for (Eigen::Index v = 0; v < mesh.vertices.cols(); ++v) points.push_back(mesh.vertices.col(v));
  const auto middle = [&](int a, int b) {
    const auto [entry, fresh] =
        middles.try_emplace(std::minmax(a, b), static_cast<int>(points.size()));
    if (fresh) points.emplace_back(0.5 * (mesh.vertices.col(a) + mesh.vertices.col(b)));
    return entry->second;
  };
  TriangleMesh result;
  result.triangles.resize(3, 4 * mesh.size());
  for (Eigen::Index t = 0; t < mesh.size(); ++t) {
    const int a = mesh.triangles(0, t), b = mesh.triangles(1, t), c = mesh.triangles(2, t);
    const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    result.triangles.col(4 * t) << a, ab, ca;
    result.triangles.col(4 * t + 1) << b, bc, ab;
    result.triangles.col(4 * t + 2) << c, ca, bc;
    result.triangles.col(4 * t + 3) << ab, bc, ca;
  }
  result.vertices.resize(3, static_cast<Eigen::Index>(points.size()));
  for (std::size_t v = 0; v < points.size(); ++v)
    result.vertices.col(static_cast<Eigen::Index>(v)) = points[v];
  return result;
}

/// An axis-parallel box of the given full sides, centred on the origin: 12 triangles.
inline TriangleMesh box(const Eigen::Vector3d& sides) {
  TriangleMesh mesh;
  mesh.vertices.resize(3, 8);
  for (int v = 0; v < 8; ++v)
    mesh.vertices.col(v) << (v & 1) - 0.5, (v >> 1 & 1) - 0.5, (v >> 2 & 1) - 0.5;
  mesh.vertices = sides.asDiagonal() * mesh.vertices;
  mesh.triangles.resize(3, 12);
  mesh.triangles << 0, 0, 4, 4, 0, 0, 2, 2, 0, 0, 1, 1,  //
      2, 3, 5, 7, 1, 5, 6, 7, 4, 6, 3, 7,                //
      3, 1, 7, 6, 5, 4, 7, 3, 6, 2, 7, 5;
  return mesh;
}

inline TriangleMesh cube(double side = 1.0) { return box(Eigen::Vector3d::Constant(side)); }

/// An icosahedron whose faces are cut into n^2 triangles each, all vertices on the sphere about the
/// origin: 20 n^2 triangles.
inline TriangleMesh icosphere(double radius, int n) {
  const double g = std::numbers::phi;
  Eigen::Matrix<double, 3, 12> corner;
  corner << -1, 1, -1, 1, 0, 0, 0, 0, g, g, -g, -g,  //
      g, g, -g, -g, -1, 1, -1, 1, 0, 0, 0, 0,        //
      0, 0, 0, 0, g, g, -g, -g, -1, 1, -1, 1;
  constexpr std::array<std::array<int, 3>, 20> kFaces = {
      {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
       {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
       {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};
  // A vertex is known by its three barycentric parts, each with its corner.
  std::map<std::array<int, 6>, int> known;
  std::vector<Eigen::Vector3d> points;
  std::vector<std::array<int, 3>> triangles;
  for (const auto& face : kFaces) {
    const auto vertex = [&](int i, int j) {
      std::array<std::pair<int, int>, 3> parts = {
          {{face[0], n - i - j}, {face[1], i}, {face[2], j}}};
      Eigen::Vector3d p = Eigen::Vector3d::Zero();
      for (auto& [c, weight] : parts) {
        p += weight * corner.col(c);
        if (weight == 0) c = -1;
      }
      std::sort(parts.begin(), parts.end());
      const std::array<int, 6> key = {parts[0].first,  parts[0].second, parts[1].first,
                                      parts[1].second, parts[2].first,  parts[2].second};
      const auto [entry, fresh] = known.try_emplace(key, static_cast<int>(points.size()));
      if (fresh) points.emplace_back(radius * p.normalized());
      return entry->second;
    };
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n - i; ++j) {
        triangles.push_back({vertex(i, j), vertex(i + 1, j), vertex(i, j + 1)});
        if (i + j < n - 1)
          triangles.push_back({vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
      }
  }
  TriangleMesh mesh;
  mesh.vertices.resize(3, static_cast<Eigen::Index>(points.size()));
  for (std::size_t v = 0; v < points.size(); ++v)
    mesh.vertices.col(static_cast<Eigen::Index>(v)) = points[v];
  mesh.triangles.resize(3, static_cast<Eigen::Index>(triangles.size()));
  for (std::size_t t = 0; t < triangles.size(); ++t)
    mesh.triangles.col(static_cast<Eigen::Index>(t)) << triangles[t][0], triangles[t][1],
        triangles[t][2];
  return mesh;
}

/// A torus about the z axis, `around` x `across` quadrilaterals in two triangles each.
inline TriangleMesh torus(double radius, double tube, int around, int across) {
  TriangleMesh mesh;
  mesh.vertices.resize(3, around * across);
  mesh.triangles.resize(3, 2 * around * across);
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < across; ++j) {
      const double u = 2 * std::numbers::pi * i / around, v = 2 * std::numbers::pi * j / across;
      const double r = radius + tube * std::cos(v);
      mesh.vertices.col(i * across + j) << r * std::cos(u), r * std::sin(u), tube * std::sin(v);
      const int a = i * across + j, b = (i + 1) % around * across + j;
      const int c = (i + 1) % around * across + (j + 1) % across, d = i * across + (j + 1) % across;
      mesh.triangles.col(2 * a) << a, b, c;
      mesh.triangles.col(2 * a + 1) << a, c, d;
    }
  return mesh;
}

/// A sphere with smooth bumps of the given relative height, at least `triangles` triangles. The
/// same numbers give the same mesh.
inline TriangleMesh noisy_sphere(double radius, int triangles, double bumps = 0.1,
                                 std::uint64_t seed = 1) {
  TriangleMesh mesh =
      icosphere(1.0, std::max(1, static_cast<int>(std::ceil(std::sqrt(triangles / 20.0)))));
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> part(-1.0, 1.0);
  constexpr int kWaves = 12;
  Eigen::Matrix<double, kWaves, 3> wave;
  Eigen::Matrix<double, kWaves, 1> phase;
  for (int w = 0; w < kWaves; ++w) {
    for (int d = 0; d < 3; ++d) wave(w, d) = part(random) * (3.0 + w);
    phase[w] = std::numbers::pi * part(random);
  }
  for (Eigen::Index v = 0; v < mesh.vertices.cols(); ++v) {
    const double height = (wave * mesh.vertices.col(v) + phase).array().sin().mean();
    mesh.vertices.col(v) *= radius * (1.0 + 2.0 * bumps * height);
  }
  return mesh;
}

/// The mesh without its last `count` triangles: open.
inline TriangleMesh without_last(TriangleMesh mesh, Eigen::Index count) {
  mesh.triangles.conservativeResize(3, mesh.size() - count);
  return mesh;
}

/// Both meshes as one, vertices not merged.
inline TriangleMesh join(const TriangleMesh& a, const TriangleMesh& b) {
  TriangleMesh mesh;
  mesh.vertices.resize(3, a.vertices.cols() + b.vertices.cols());
  mesh.vertices << a.vertices, b.vertices;
  mesh.triangles.resize(3, a.size() + b.size());
  mesh.triangles << a.triangles,
      (b.triangles.array() + static_cast<int>(a.vertices.cols())).matrix();
  return mesh;
}

/// Seen from the other side.
inline TriangleMesh inside_out(TriangleMesh mesh) {
  mesh.triangles.row(1).swap(mesh.triangles.row(2));
  return mesh;
}

/// Volume by the divergence theorem; positive if the triangles face outward.
inline double volume(const TriangleMesh& mesh) {
  double sum = 0.0;
  for (Eigen::Index t = 0; t < mesh.size(); ++t) {
    const Eigen::Vector3d a = mesh.vertices.col(mesh.triangles(0, t));
    const Eigen::Vector3d b = mesh.vertices.col(mesh.triangles(1, t));
    const Eigen::Vector3d c = mesh.vertices.col(mesh.triangles(2, t));
    sum += a.dot(b.cross(c)) / 6.0;
  }
  return sum;
}

}  // namespace mortise::shapes
