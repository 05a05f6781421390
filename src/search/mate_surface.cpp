// SPDX-License-Identifier: GPL-3.0-or-later
// Surface samples and distance grids of parts.
#include "search/mate_surface.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "mortise/core/errors.hpp"
#include "mortise/core/threads.hpp"

namespace mortise {

SurfaceSamples sample_surface(const TriangleMesh& mesh, Eigen::Index count) {
  std::vector<double> up_to;  // area of the triangles up to and with each one
  double area = 0.0;
  for (Eigen::Index t = 0; t < mesh.size(); ++t) {
    const Eigen::Vector3d a = mesh.vertices.col(mesh.triangles(0, t));
    const Eigen::Vector3d b = mesh.vertices.col(mesh.triangles(1, t));
    const Eigen::Vector3d c = mesh.vertices.col(mesh.triangles(2, t));
    area += 0.5 * (b - a).cross(c - a).norm();
    up_to.push_back(area);
  }
  if (!(area > 0.0)) throw InputError("mate: expected a part with a surface, found area 0");
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
    samples.points.col(i) = (a + u * (b - a) + v * (c - a)).cast<float>();
    samples.normals.col(i) = (b - a).cross(c - a).normalized().cast<float>();
  }
  return samples;
}

DistanceField::DistanceField(const Solid& solid, double spacing, double margin, int threads)
    : spacing_(spacing), inverse_(static_cast<float>(1.0 / spacing)) {
  Eigen::AlignedBox3d box = solid.bounds();
  const Eigen::Vector3d low = box.min().array() - margin;
  low_ = low.cast<float>();
  for (int d = 0; d < 3; ++d) {
    const auto axis = static_cast<std::size_t>(d);
    size_[axis] = static_cast<int>(std::ceil((box.sizes()[d] + 2.0 * margin) / spacing)) + 2;
    last_[axis] = static_cast<float>(size_[axis] - 1);
  }
  step_x_ = static_cast<std::ptrdiff_t>(size_[1]) * size_[2];
  values_.resize(static_cast<std::size_t>(size_[0]) * static_cast<std::size_t>(step_x_));
  parallel_for(static_cast<std::size_t>(size_[0]), threads, [&](std::size_t i, int) {
    Eigen::Matrix3Xd nodes(3, step_x_);
    for (std::ptrdiff_t n = 0; n < step_x_; ++n)
      nodes.col(n) =
          low + spacing * Eigen::Vector3d(static_cast<double>(i), static_cast<double>(n / size_[2]),
                                          static_cast<double>(n % size_[2]));
    const Eigen::VectorXd distance =
        solid.signed_distance(nodes, std::numeric_limits<double>::infinity());
    std::transform(distance.begin(), distance.end(),
                   values_.begin() + static_cast<std::ptrdiff_t>(i) * step_x_,
                   [](double d) { return static_cast<float>(d); });
  });
}

Eigen::Vector3d DistanceField::high() const {
  return low() + spacing_ * Eigen::Vector3d(size_[0] - 1, size_[1] - 1, size_[2] - 1);
}

}  // namespace mortise
