// SPDX-License-Identifier: GPL-3.0-or-later
// Triangle meshes to CGAL's Surface_mesh and back, whatever its kernel.
#pragma once

#include <CGAL/Surface_mesh.h>
#include <CGAL/number_utils.h>

#include "mortise/parts/triangle_mesh.hpp"

namespace mortise::reference {

template <class Kernel>
CGAL::Surface_mesh<typename Kernel::Point_3> surface_of(const TriangleMesh& mesh) {
  CGAL::Surface_mesh<typename Kernel::Point_3> surface;
  for (Eigen::Index v = 0; v < mesh.vertices.cols(); ++v)
    surface.add_vertex({mesh.vertices(0, v), mesh.vertices(1, v), mesh.vertices(2, v)});
  using Vertex = typename decltype(surface)::Vertex_index;
  for (Eigen::Index t = 0; t < mesh.size(); ++t)
    surface.add_face(Vertex(static_cast<unsigned>(mesh.triangles(0, t))),
                     Vertex(static_cast<unsigned>(mesh.triangles(1, t))),
                     Vertex(static_cast<unsigned>(mesh.triangles(2, t))));
  return surface;
}

/// @param surface  all faces triangles
template <class Point>
TriangleMesh mesh_of(const CGAL::Surface_mesh<Point>& surface) {
  TriangleMesh mesh;
  mesh.vertices.resize(3, static_cast<Eigen::Index>(surface.number_of_vertices()));
  mesh.triangles.resize(3, static_cast<Eigen::Index>(surface.number_of_faces()));
  for (const auto v : surface.vertices())
    for (int d = 0; d < 3; ++d)
      mesh.vertices(d, static_cast<Eigen::Index>(v)) = CGAL::to_double(surface.point(v)[d]);
  Eigen::Index t = 0;
  for (const auto face : surface.faces()) {
    int corner = 0;
    for (const auto v : surface.vertices_around_face(surface.halfedge(face)))
      mesh.triangles(corner++, t) = static_cast<int>(static_cast<unsigned>(v));
    ++t;
  }
  return mesh;
}

}  // namespace mortise::reference
