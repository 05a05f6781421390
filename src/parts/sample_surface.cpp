// SPDX-License-Identifier: GPL-3.0-or-later
// Quasi-random points on a triangle mesh.
#include "mortise/parts/sample_surface.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "mortise/core/errors.hpp"

namespace mortise {
namespace {

// Of the triangles up to and with each one.
std::vector<double> summed_areas(const TriangleMesh& mesh) {
  std::vector<double> up_to;
  up_to.reserve(static_cast<std::size_t>(mesh.size()));
  double area = 0.0;
  for (Eigen::Index t = 0; t < mesh.size(); ++t) {
    const Eigen::Vector3d a = mesh.vertices.col(mesh.triangles(0, t));
    const Eigen::Vector3d b = mesh.vertices.col(mesh.triangles(1, t));
    const Eigen::Vector3d c = mesh.vertices.col(mesh.triangles(2, t));
    area += 0.5 * (b - a).cross(c - a).norm();
    up_to.push_back(area);
  }
  return up_to;
}

}  // namespace

double surface_area(const TriangleMesh& mesh) {
  const std::vector<double> up_to = summed_areas(mesh);
  return up_to.empty() ? 0.0 : up_to.back();
}

SurfaceSamples sample_surface(const TriangleMesh& mesh, Eigen::Index count) {
  const std::vector<double> up_to = summed_areas(mesh);
  const double area = up_to.empty() ? 0.0 : up_to.back();
  if (!(area > 0.0))
    throw InputError("sample_surface: expected a mesh with a surface, found area 0");
  SurfaceSamples samples;
  samples.area = area;
  samples.points.resize(3, count);
  samples.normals.resize(3, count);
  const auto fraction = [](double x) { return x - std::floor(x); };
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto n = static_cast<double>(i);
    const double place = area * fraction(0.5 + n * 0.6180339887498949);
    auto t = static_cast<Eigen::Index>(std::upper_bound(up_to.begin(), up_to.end(), place) -
                                       up_to.begin());
    t = std::min(t, mesh.size() - 1);
    const Eigen::Vector3d a = mesh.vertices.col(mesh.triangles(0, t));
    const Eigen::Vector3d b = mesh.vertices.col(mesh.triangles(1, t));
    const Eigen::Vector3d c = mesh.vertices.col(mesh.triangles(2, t));
    double u = fraction(0.5 + n * 0.7548776662466927);
    double v = fraction(0.5 + n * 0.5698402909980532);
    if (u + v > 1.0) {
      u = 1.0 - u;
      v = 1.0 - v;
    }
    samples.points.col(i) = (a + u * (b - a) + v * (c - a));
    samples.normals.col(i) = (b - a).cross(c - a).normalized();
  }
  return samples;
}

}  // namespace mortise
