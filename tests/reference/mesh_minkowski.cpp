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

#include "reference/cgal_mesh.hpp"

namespace mortise::reference {
namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Nef = CGAL::Nef_polyhedron_3<Kernel>;

}  // namespace

TriangleMesh minkowski_sum(const TriangleMesh& a, const TriangleMesh& b) {
  Nef first(surface_of<Kernel>(a)), second(surface_of<Kernel>(b));
  const Nef sum = CGAL::minkowski_sum_3(first, second);
  CGAL::Surface_mesh<Kernel::Point_3> surface;
  CGAL::convert_nef_polyhedron_to_polygon_mesh(sum, surface);
  CGAL::Polygon_mesh_processing::triangulate_faces(surface);
  return mesh_of(surface);
}

}  // namespace mortise::reference
