// SPDX-License-Identifier: GPL-3.0-or-later
// CGAL's distance to a mesh and the whole sum of solid angles.
#include "reference/mesh_queries.hpp"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <vector>

namespace mortise::reference {

Eigen::VectorXd distance(const TriangleMesh& mesh, const Eigen::Matrix3Xd& points) {
  using Kernel = CGAL::Simple_cartesian<double>;
  using Triangles = std::vector<Kernel::Triangle_3>;
  using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
  Triangles triangles;
  const auto point = [&](Eigen::Index v) {
    return Kernel::Point_3(mesh.vertices(0, v), mesh.vertices(1, v), mesh.vertices(2, v));
  };
  for (Eigen::Index t = 0; t < mesh.size(); ++t)
    triangles.emplace_back(point(mesh.triangles(0, t)), point(mesh.triangles(1, t)),
                           point(mesh.triangles(2, t)));
  CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>> tree(triangles.begin(), triangles.end());
  tree.accelerate_distance_queries();
  Eigen::VectorXd result(points.cols());
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    result[i] = std::sqrt(tree.squared_distance({points(0, i), points(1, i), points(2, i)}));
  return result;
}

double winding_number(const TriangleMesh& mesh, const Eigen::Vector3d& point) {
  double sum = 0.0;
  for (Eigen::Index t = 0; t < mesh.size(); ++t) {
    const Eigen::Vector3d a = mesh.vertices.col(mesh.triangles(0, t)) - point;
    const Eigen::Vector3d b = mesh.vertices.col(mesh.triangles(1, t)) - point;
    const Eigen::Vector3d c = mesh.vertices.col(mesh.triangles(2, t)) - point;
    sum +=
        2.0 * std::atan2(a.dot(b.cross(c)), a.norm() * b.norm() * c.norm() + a.dot(b) * c.norm() +
                                                b.dot(c) * a.norm() + c.dot(a) * b.norm());
  }
  return sum / (4.0 * std::numbers::pi);
}

}  // namespace mortise::reference
