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

namespace mortise::reference {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
using Tree =
    CGAL::AABB_tree<CGAL::AABB_traits<Kernel, CGAL::AABB_face_graph_triangle_primitive<Surface>>>;

Surface surface_of(const TriangleMesh& mesh) {
  Surface surface;
  for (Eigen::Index v = 0; v < mesh.vertices.cols(); ++v)
    surface.add_vertex({mesh.vertices(0, v), mesh.vertices(1, v), mesh.vertices(2, v)});
  for (Eigen::Index t = 0; t < mesh.size(); ++t)
    surface.add_face(Surface::Vertex_index(static_cast<unsigned>(mesh.triangles(0, t))),
                     Surface::Vertex_index(static_cast<unsigned>(mesh.triangles(1, t))),
                     Surface::Vertex_index(static_cast<unsigned>(mesh.triangles(2, t))));
  return surface;
}

TriangleMesh mesh_of(const Surface& surface) {
  TriangleMesh mesh;
  mesh.vertices.resize(3, static_cast<Eigen::Index>(surface.number_of_vertices()));
  mesh.triangles.resize(3, static_cast<Eigen::Index>(surface.number_of_faces()));
  for (const auto v : surface.vertices())
    for (int d = 0; d < 3; ++d)
      mesh.vertices(d, static_cast<Eigen::Index>(v)) = surface.point(v)[d];
  Eigen::Index t = 0;
  for (const auto face : surface.faces()) {
    int corner = 0;
    for (const auto v : surface.vertices_around_face(surface.halfedge(face)))
      mesh.triangles(corner++, t) = static_cast<int>(static_cast<unsigned>(v));
    ++t;
  }
  return mesh;
}

}  // namespace

MeshOverlap mesh_overlap(const TriangleMesh& a, const TriangleMesh& b) {
  Surface first = surface_of(a), second = surface_of(b), common;
  if (!CGAL::Polygon_mesh_processing::corefine_and_compute_intersection(first, second, common))
    throw std::runtime_error("mesh_overlap: the meshes cannot be corefined");
  MeshOverlap overlap;
  if (common.is_empty()) return overlap;
  common.collect_garbage();
  overlap.volume = CGAL::Polygon_mesh_processing::volume(common);
  const Surface plain_first = surface_of(a), plain_second = surface_of(b);
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
