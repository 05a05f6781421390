// SPDX-License-Identifier: GPL-3.0-or-later
// What two closed meshes have in common, by CGAL.
#include "reference/mesh_overlap.hpp"

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "mortise/parts/sample_surface.hpp"
#include "reference/cgal_mesh.hpp"

namespace mortise::reference {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
using Tree =
    CGAL::AABB_tree<CGAL::AABB_traits<Kernel, CGAL::AABB_face_graph_triangle_primitive<Surface>>>;

}  // namespace

MeshOverlap mesh_overlap(const TriangleMesh& a, const TriangleMesh& b) {
  Surface first = surface_of<Kernel>(a), second = surface_of<Kernel>(b), common;
  if (!CGAL::Polygon_mesh_processing::corefine_and_compute_intersection(first, second, common))
    throw std::runtime_error("mesh_overlap: the meshes cannot be corefined");
  MeshOverlap overlap;
  if (common.is_empty()) return overlap;
  common.collect_garbage();
  overlap.volume = CGAL::Polygon_mesh_processing::volume(common);
  const Surface plain_first = surface_of<Kernel>(a), plain_second = surface_of<Kernel>(b);
  const Tree near_first(faces(plain_first).begin(), faces(plain_first).end(), plain_first);
  const Tree near_second(faces(plain_second).begin(), faces(plain_second).end(), plain_second);
  const TriangleMesh boundary = mesh_of(common);
  const auto look = [&](const Eigen::Matrix3Xd& points) {
    for (const auto& x : points.colwise()) {
      const Kernel::Point_3 p(x[0], x[1], x[2]);
      const double square =
          std::max(near_first.squared_distance(p), near_second.squared_distance(p));
      overlap.depth = std::max(overlap.depth, std::sqrt(square));
    }
  };
  look(boundary.vertices);
  look(sample_surface(boundary, 20000).points);
  return overlap;
}

}  // namespace mortise::reference
