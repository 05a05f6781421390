// SPDX-License-Identifier: GPL-3.0-or-later
// CGAL's alpha wrap of a soup.
#include "parts/wrap.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/alpha_wrap_3.h>

namespace mortise::parts {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

}  // namespace

TriangleMesh wrap(const Surface& surface, double alpha, double offset) {
  std::vector<Kernel::Point_3> points;
  points.reserve(surface.points.size());
  for (const Eigen::Vector3d& p : surface.points) points.emplace_back(p.x(), p.y(), p.z());
  std::vector<std::array<std::size_t, 3>> faces;
  faces.reserve(surface.triangles.size());
  for (const auto& t : surface.triangles)
    faces.push_back({static_cast<std::size_t>(t[0]), static_cast<std::size_t>(t[1]),
                     static_cast<std::size_t>(t[2])});
  CGAL::Surface_mesh<Kernel::Point_3> wrapped;
  CGAL::alpha_wrap_3(points, faces, alpha, offset, wrapped);
  TriangleMesh mesh;
  mesh.vertices.resize(3, static_cast<Eigen::Index>(wrapped.number_of_vertices()));
  mesh.triangles.resize(3, static_cast<Eigen::Index>(wrapped.number_of_faces()));
  for (const auto v : wrapped.vertices())
    for (int d = 0; d < 3; ++d)
      mesh.vertices(d, static_cast<Eigen::Index>(v)) = wrapped.point(v)[d];
  Eigen::Index t = 0;
  for (const auto face : wrapped.faces()) {
    int corner = 0;
    for (const auto v : wrapped.vertices_around_face(wrapped.halfedge(face)))
      mesh.triangles(corner++, t) = static_cast<int>(static_cast<unsigned>(v));
    ++t;
  }
  return mesh;
}

}  // namespace mortise::parts
