// SPDX-License-Identifier: GPL-3.0-or-later
// Outermost vertices and the diameter.
#include "mortise/parts/diameter.hpp"

#include <algorithm>
#include <cmath>

#include "core/sphere_points.hpp"
#include "mortise/core/errors.hpp"

namespace mortise {

std::vector<Eigen::Index> outermost_vertices(const Eigen::Matrix3Xd& vertices, int directions) {
  if (vertices.cols() == 0) throw InputError("diameter: expected at least one vertex, got none");
  const Eigen::Vector3d centre =
      0.5 * (vertices.rowwise().minCoeff() + vertices.rowwise().maxCoeff());
  const Eigen::Matrix3Xd centred = vertices.colwise() - centre;
  std::vector<Eigen::Index> found;
  const Eigen::Matrix3Xd everywhere = detail::fibonacci_sphere(directions);
  for (const auto& direction : everywhere.colwise()) {
    Eigen::Index at = 0;
    (direction.transpose() * centred).maxCoeff(&at);
    found.push_back(at);
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

double diameter_of(const Eigen::Matrix3Xd& vertices) {
  double largest_sq = 0.0;
  const std::vector<Eigen::Index> ends = outermost_vertices(vertices);
  for (const Eigen::Index a : ends)
    for (const Eigen::Index b : ends)
      largest_sq = std::max(largest_sq, (vertices.col(a) - vertices.col(b)).squaredNorm());
  return std::sqrt(largest_sq);
}

}  // namespace mortise
