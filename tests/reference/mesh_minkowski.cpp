// SPDX-License-Identifier: GPL-3.0-or-later
// The exact Minkowski sum of two closed meshes, by CGAL's Nef polyhedra.
#include "reference/mesh_minkowski.hpp"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Nef_polyhedron_3.h>
#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/convert_nef_polyhedron_to_polygon_mesh.h>
#include <CGAL/minkowski_sum_3.h>

namespace mortise::reference {
namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
using Nef = CGAL::Nef_polyhedron_3<Kernel>;

Nef nef(const TriangleMesh& mesh) {
  Surface surface;
  for (Eigen::Index v = 0; v < mesh.vertices.cols(); ++v)
    surface.add_vertex({mesh.vertices(0, v), mesh.vertices(1, v), mesh.vertices(2, v)});
  for (Eigen::Index t = 0; t < mesh.size(); ++t)
    surface.add_face(Surface::Vertex_index(static_cast<unsigned>(mesh.triangles(0, t))),
                     Surface::Vertex_index(static_cast<unsigned>(mesh.triangles(1, t))),
                     Surface::Vertex_index(static_cast<unsigned>(mesh.triangles(2, t))));
  return Nef(surface);
}

}  // namespace

TriangleMesh minkowski_sum(const TriangleMesh& a, const TriangleMesh& b) {
  Nef first = nef(a), second = nef(b);
  const Nef sum = CGAL::minkowski_sum_3(first, second);
  Surface surface;
  CGAL::convert_nef_polyhedron_to_polygon_mesh(sum, surface);
  CGAL::Polygon_mesh_processing::triangulate_faces(surface);
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
