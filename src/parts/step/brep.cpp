// SPDX-License-Identifier: GPL-3.0-or-later
// Tessellation, motion and faceted solids by OpenCASCADE.
#include "parts/step/brep.hpp"

#include <BRepBndLib.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_Transform.hxx>
#include <BRepMesh_IncrementalMesh.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <Poly_Triangulation.hxx>
#include <Precision.hxx>
#include <TopExp_Explorer.hxx>
#include <TopLoc_Location.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Shell.hxx>
#include <TopoDS_Solid.hxx>
#include <TopoDS_Vertex.hxx>
#include <TopoDS_Wire.hxx>
#include <algorithm>
#include <cmath>
#include <gp_Pln.hxx>
#include <gp_Trsf.hxx>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include "mortise/core/errors.hpp"

namespace mortise::brep {

double diagonal(const TopoDS_Shape& shape) {
  Bnd_Box box;
  BRepBndLib::AddOptimal(shape, box, Standard_False, Standard_False);
  return box.IsVoid() ? 0.0 : std::sqrt(box.SquareExtent());
}

TriangleMesh tessellate(const TopoDS_Shape& shape, const Fineness& fineness) {
  IMeshTools_Parameters parameters;
  parameters.Deflection = fineness.deviation;
  parameters.Angle = fineness.angle;
  parameters.Relative = Standard_False;
  parameters.InParallel = Standard_False;  // the same triangles on every machine
  parameters.MinSize = std::max(fineness.smallest, 0.02 * fineness.deviation);
  const BRepMesh_IncrementalMesh mesher(shape, parameters);

  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector3i> triangles;
  for (TopExp_Explorer faces(shape, TopAbs_FACE); faces.More(); faces.Next()) {
    const TopoDS_Face& face = TopoDS::Face(faces.Current());
    TopLoc_Location location;
    const Handle(Poly_Triangulation) triangulation = BRep_Tool::Triangulation(face, location);
    if (triangulation.IsNull()) continue;
    const gp_Trsf placement = location.Transformation();
    const int first = static_cast<int>(points.size());
    for (int i = 1; i <= triangulation->NbNodes(); ++i) {
      const gp_Pnt p = triangulation->Node(i).Transformed(placement);
      points.emplace_back(p.X(), p.Y(), p.Z());
    }
    const bool turned = (face.Orientation() == TopAbs_REVERSED) != placement.IsNegative();
    for (int i = 1; i <= triangulation->NbTriangles(); ++i) {
      int a = 0;
      int b = 0;
      int c = 0;
      triangulation->Triangle(i).Get(a, b, c);
      if (turned) std::swap(b, c);
      triangles.emplace_back(first + a - 1, first + b - 1, first + c - 1);
    }
  }
  TriangleMesh mesh;
  mesh.vertices.resize(3, static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i)
    mesh.vertices.col(static_cast<Eigen::Index>(i)) = points[i];
  mesh.triangles.resize(3, static_cast<Eigen::Index>(triangles.size()));
  for (std::size_t i = 0; i < triangles.size(); ++i)
    mesh.triangles.col(static_cast<Eigen::Index>(i)) = triangles[i];
  return mesh;
}

TopoDS_Shape moved(const TopoDS_Shape& shape, const RigidMotion& motion) {
  const Eigen::Matrix3d R = motion.rotation.normalized().toRotationMatrix();
  const Eigen::Vector3d& t = motion.translation;
  gp_Trsf trsf;
  trsf.SetValues(R(0, 0), R(0, 1), R(0, 2), t.x(), R(1, 0), R(1, 1), R(1, 2), t.y(), R(2, 0),
                 R(2, 1), R(2, 2), t.z());
  return BRepBuilderAPI_Transform(shape, trsf, Standard_True).Shape();
}

namespace {

gp_Pnt point_of(const TriangleMesh& mesh, int i) {
  return {mesh.vertices(0, i), mesh.vertices(1, i), mesh.vertices(2, i)};
}

/// Which connected shell each triangle belongs to.
std::vector<int> shells_of(const TriangleMesh& mesh) {
  std::vector<int> parent(static_cast<std::size_t>(mesh.vertices.cols()));
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int v) {
    while (parent[static_cast<std::size_t>(v)] != v) {
      int& up = parent[static_cast<std::size_t>(v)];
      up = parent[static_cast<std::size_t>(up)];
      v = up;
    }
    return v;
  };
  for (const auto t : mesh.triangles.colwise()) {
    for (int k = 1; k < 3; ++k) parent[static_cast<std::size_t>(root(t(k)))] = root(t(0));
  }
  std::map<int, int> number;
  std::vector<int> shells;
  shells.reserve(static_cast<std::size_t>(mesh.size()));
  for (const auto t : mesh.triangles.colwise()) {
    const int next = static_cast<int>(number.size());
    shells.push_back(number.emplace(root(t(0)), next).first->second);
  }
  return shells;
}

}  // namespace

TopoDS_Shape faceted(const TriangleMesh& mesh) {
  const BRep_Builder builder;
  std::vector<TopoDS_Vertex> vertices(static_cast<std::size_t>(mesh.vertices.cols()));
  for (std::size_t i = 0; i < vertices.size(); ++i)
    builder.MakeVertex(vertices[i], point_of(mesh, static_cast<int>(i)), Precision::Confusion());
  std::map<std::pair<int, int>, TopoDS_Edge> edges;
  const auto edge = [&](int a, int b) {
    auto& e = edges[std::minmax(a, b)];
    if (e.IsNull()) {
      e = BRepBuilderAPI_MakeEdge(vertices[static_cast<std::size_t>(std::min(a, b))],
                                  vertices[static_cast<std::size_t>(std::max(a, b))]);
    }
    return TopoDS::Edge(e.Oriented(a < b ? TopAbs_FORWARD : TopAbs_REVERSED));
  };

  const std::vector<int> shell_of = shells_of(mesh);
  std::vector<TopoDS_Shell> shells(
      shell_of.empty()
          ? 0
          : static_cast<std::size_t>(1 + *std::max_element(shell_of.begin(), shell_of.end())));
  for (auto& shell : shells) builder.MakeShell(shell);
  for (Eigen::Index i = 0; i < mesh.size(); ++i) {
    const Eigen::Vector3i t = mesh.triangles.col(i);
    const Eigen::Vector3d a = mesh.vertices.col(t(0));
    const Eigen::Vector3d normal =
        (mesh.vertices.col(t(1)) - a).cross(mesh.vertices.col(t(2)) - a).normalized();
    TopoDS_Wire wire;
    builder.MakeWire(wire);
    for (int k = 0; k < 3; ++k) builder.Add(wire, edge(t(k), t((k + 1) % 3)));
    wire.Closed(Standard_True);
    const gp_Pln plane(point_of(mesh, t(0)), gp_Dir(normal.x(), normal.y(), normal.z()));
    builder.Add(shells[static_cast<std::size_t>(shell_of[static_cast<std::size_t>(i)])],
                BRepBuilderAPI_MakeFace(plane, wire, Standard_True).Face());
  }
  TopoDS_Compound all;
  builder.MakeCompound(all);
  TopoDS_Solid solid;
  for (auto& shell : shells) {
    shell.Closed(Standard_True);
    builder.MakeSolid(solid);
    builder.Add(solid, shell);
    builder.Add(all, solid);
  }
  if (shells.size() == 1) return solid;
  return all;
}

}  // namespace mortise::brep
