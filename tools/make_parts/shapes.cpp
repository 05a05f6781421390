// SPDX-License-Identifier: GPL-3.0-or-later
// Primitives and booleans by OpenCASCADE; a boolean that fails stops the program.
#include "shapes.hpp"

#include <BRepAlgoAPI_Common.hxx>
#include <BRepAlgoAPI_Cut.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCone.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <ShapeUpgrade_UnifySameDomain.hxx>
#include <TopExp_Explorer.hxx>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace mortise::parts_maker {
namespace {

gp_Pnt point(const Eigen::Vector3d& p) { return {p.x(), p.y(), p.z()}; }
gp_Dir direction(const Eigen::Vector3d& d) { return {d.x(), d.y(), d.z()}; }

/// The one solid of a boolean's result, with faces and edges that were split for nothing joined.
template <class Boolean>
TopoDS_Shape one_solid(const TopoDS_Shape& a, const TopoDS_Shape& b, const char* name) {
  Boolean boolean(a, b);
  if (!boolean.IsDone()) throw std::runtime_error(std::string(name) + " failed");
  ShapeUpgrade_UnifySameDomain unify(boolean.Shape());
  unify.Build();
  TopExp_Explorer solids(unify.Shape(), TopAbs_SOLID);
  if (!solids.More()) throw std::runtime_error(std::string(name) + ": nothing left");
  const TopoDS_Shape solid = solids.Current();
  solids.Next();
  if (solids.More()) throw std::runtime_error(std::string(name) + ": more than one piece");
  if (!BRepCheck_Analyzer(solid).IsValid())
    throw std::runtime_error(std::string(name) + ": invalid solid");
  return solid;
}

}  // namespace

TopoDS_Shape box(const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  return BRepPrimAPI_MakeBox(point(low), point(high)).Solid();
}

TopoDS_Shape cylinder(const Eigen::Vector3d& base, const Eigen::Vector3d& axis, double radius,
                      double height) {
  return BRepPrimAPI_MakeCylinder(gp_Ax2(point(base), direction(axis)), radius, height).Solid();
}

TopoDS_Shape cone(const Eigen::Vector3d& base, double low, double high, double height) {
  return BRepPrimAPI_MakeCone(gp_Ax2(point(base), gp_Dir(0, 0, 1)), low, high, height).Solid();
}

TopoDS_Shape ball(const Eigen::Vector3d& centre, double radius) {
  return BRepPrimAPI_MakeSphere(point(centre), radius).Solid();
}

TopoDS_Shape prism(const std::vector<Eigen::Vector3d>& polygon, const Eigen::Vector3d& sweep) {
  BRepBuilderAPI_MakePolygon wire;
  for (const auto& p : polygon) wire.Add(point(p));
  wire.Close();
  return BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(wire.Wire()).Face(),
                               gp_Vec(sweep.x(), sweep.y(), sweep.z()))
      .Shape();
}

TopoDS_Shape regular_prism(int sides, double flat_radius, double first_corner,
                           const Eigen::Vector3d& base, double height) {
  std::vector<Eigen::Vector3d> polygon;
  const double corner_radius = flat_radius / std::cos(std::numbers::pi / sides);
  for (int i = 0; i < sides; ++i) {
    const double angle = first_corner + 2.0 * std::numbers::pi * i / sides;
    polygon.emplace_back(base +
                         corner_radius * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0));
  }
  return prism(polygon, height * Eigen::Vector3d::UnitZ());
}

TopoDS_Shape fuse(const TopoDS_Shape& a, const TopoDS_Shape& b) {
  return one_solid<BRepAlgoAPI_Fuse>(a, b, "fuse");
}
TopoDS_Shape cut(const TopoDS_Shape& a, const TopoDS_Shape& b) {
  return one_solid<BRepAlgoAPI_Cut>(a, b, "cut");
}
TopoDS_Shape common(const TopoDS_Shape& a, const TopoDS_Shape& b) {
  return one_solid<BRepAlgoAPI_Common>(a, b, "common");
}

}  // namespace mortise::parts_maker
