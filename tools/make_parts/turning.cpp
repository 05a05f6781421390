// SPDX-License-Identifier: GPL-3.0-or-later
// Sample pairs that turn: ball and socket, hinge, gears, thread and nut.
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeSolid.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepBuilderAPI_Sewing.hxx>
#include <BRepLib.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <BRep_Tool.hxx>
#include <GC_MakeArcOfCircle.hxx>
#include <GeomAPI_Interpolate.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_Curve.hxx>
#include <Geom_TrimmedCurve.hxx>
#include <TColgp_HArray1OfPnt.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Shell.hxx>
#include <TopoDS_Solid.hxx>
#include <cmath>
#include <complex>
#include <gp_Pln.hxx>
#include <numbers>

#include "pair.hpp"
#include "shapes.hpp"

namespace mortise::parts_maker {
namespace {

using Eigen::Vector3d;
using std::numbers::pi;
const Vector3d kAlong = Vector3d::UnitY();

gp_Pnt polar(double radius, double angle) {
  return {radius * std::cos(angle), radius * std::sin(angle), 0};
}

struct Gear {
  int teeth;
  double module;
  double thickness;  ///< of a tooth at the pitch circle, along the circle
  double first;      ///< angle of a tooth's middle
};

/// A spur gear's outline: involute flanks, radial below the base circle, arcs at tip and root.
TopoDS_Face gear_outline(const Gear& gear) {
  const double pitch = 0.5 * gear.module * gear.teeth;
  const double base = pitch * std::cos(20 * pi / 180);
  const double tip = pitch + gear.module;
  const double root = pitch - 1.25 * gear.module;
  const auto involute = [&](double radius) {
    const double a = std::acos(base / radius);
    return std::tan(a) - a;
  };
  const double half = 0.5 * gear.thickness / pitch + involute(pitch);  // half angle at the base
  constexpr int kPoints = 9;
  BRepBuilderAPI_MakeWire wire;
  const double step = 2 * pi / gear.teeth;
  for (int i = 0; i < gear.teeth; ++i) {
    const double middle = gear.first + step * i;
    const auto flank = [&](double sign) {
      const Handle(TColgp_HArray1OfPnt) points = new TColgp_HArray1OfPnt(1, kPoints);
      for (int k = 0; k < kPoints; ++k) {
        const double radius = base + (tip - base) * (k * k) / double((kPoints - 1) * (kPoints - 1));
        points->SetValue(k + 1, polar(radius, middle + sign * (half - involute(radius))));
      }
      GeomAPI_Interpolate fit(points, Standard_False, 1e-7);
      fit.Perform();
      return fit.Curve();
    };
    const double at_tip = half - involute(tip);
    wire.Add(BRepBuilderAPI_MakeEdge(polar(root, middle - half), polar(base, middle - half)));
    wire.Add(BRepBuilderAPI_MakeEdge(flank(-1)));
    wire.Add(
        BRepBuilderAPI_MakeEdge(GC_MakeArcOfCircle(polar(tip, middle - at_tip), polar(tip, middle),
                                                   polar(tip, middle + at_tip))
                                    .Value()));
    wire.Add(BRepBuilderAPI_MakeEdge(flank(1)));
    wire.Add(BRepBuilderAPI_MakeEdge(polar(base, middle + half), polar(root, middle + half)));
    wire.Add(BRepBuilderAPI_MakeEdge(GC_MakeArcOfCircle(polar(root, middle + half),
                                                        polar(root, middle + 0.5 * step),
                                                        polar(root, middle + step - half))
                                         .Value()));
  }
  return BRepBuilderAPI_MakeFace(gp_Pln(gp::XOY()), wire.Wire(), Standard_True).Face();
}

TopoDS_Shape gear_blank(const Gear& gear, double width) {
  return BRepPrimAPI_MakePrism(gear_outline(gear), gp_Vec(0, 0, width)).Shape();
}

struct Thread {
  double radius;  ///< mean
  double amplitude;
  double pitch;
  double low;  ///< z of its ends
  double high;
};

/// The surface |xy| = radius + amplitude cos(phi - 2 pi z / pitch), a right-handed round thread, as
/// a bicubic B-spline: uniform knots multiply the mode exp(i k u) of the control points by
/// (4 + 2 cos(k du)) / 6, so the control points are the samples divided by that.
Handle(Geom_BSplineSurface) thread_surface(const Thread& thread) {
  constexpr int kAround = 16;
  constexpr int kPerTurn = 12;
  const double du = 2 * pi / kAround;
  const double dv = 2 * pi / kPerTurn;
  const int spans =
      static_cast<int>(std::ceil((thread.high - thread.low) / thread.pitch * kPerTurn - 1e-9));
  const int rows = spans + 3;
  const auto damping = [](double phase) { return (4 + 2 * std::cos(phase)) / 6; };
  TColgp_Array2OfPnt poles(1, kAround, 1, rows);
  for (int j = 0; j < rows; ++j) {
    const double z = thread.low + (j - 1) * thread.pitch / kPerTurn;
    const std::complex<double> turn = std::polar(1 / damping(dv), 2 * pi * z / thread.pitch);
    for (int i = 0; i < kAround; ++i) {
      const double u = i * du;
      const std::complex<double> around =
          thread.radius * std::polar(1 / damping(du), u) +
          0.5 * thread.amplitude * (1.0 + std::polar(1 / damping(2 * du), 2 * u));
      const std::complex<double> p = turn * around;
      poles.SetValue(i + 1, j + 1, gp_Pnt(p.real(), p.imag(), z));
    }
  }
  TColStd_Array1OfReal u_knots(1, kAround + 1);
  TColStd_Array1OfInteger u_mults(1, kAround + 1);
  for (int i = 0; i <= kAround; ++i) {
    u_knots.SetValue(i + 1, i);
    u_mults.SetValue(i + 1, 1);
  }
  TColStd_Array1OfReal v_knots(1, rows + 4);
  TColStd_Array1OfInteger v_mults(1, rows + 4);
  for (int j = 0; j < rows + 4; ++j) {
    v_knots.SetValue(j + 1, j - 3);
    v_mults.SetValue(j + 1, 1);
  }
  Handle(Geom_BSplineSurface) surface = new Geom_BSplineSurface(
      poles, u_knots, v_knots, u_mults, v_mults, 3, 3, Standard_True, Standard_False);
  surface->SetUNotPeriodic();
  surface->Segment(0, kAround, 0, (thread.high - thread.low) / thread.pitch * kPerTurn);
  return surface;
}

TopoDS_Shape thread_solid(const Thread& thread) {
  const TopoDS_Face side = BRepBuilderAPI_MakeFace(thread_surface(thread), 1e-6).Face();
  BRepBuilderAPI_Sewing sewing(1e-5);
  sewing.Add(side);
  for (TopExp_Explorer edges(side, TopAbs_EDGE); edges.More(); edges.Next()) {
    const TopoDS_Edge edge = TopoDS::Edge(edges.Current());
    Standard_Real first = 0;
    Standard_Real last = 0;
    const Handle(Geom_Curve) curve = BRep_Tool::Curve(edge, first, last);
    const double z = curve->Value(first).Z();
    if (std::abs(z - curve->Value(0.5 * (first + last)).Z()) > 1e-6) continue;  // the seam
    sewing.Add(BRepBuilderAPI_MakeFace(gp_Pln(gp_Pnt(0, 0, z), gp_Dir(0, 0, 1)),
                                       BRepBuilderAPI_MakeWire(edge).Wire()));
  }
  sewing.Perform();
  const TopExp_Explorer shells(sewing.SewedShape(), TopAbs_SHELL);
  TopoDS_Solid solid = BRepBuilderAPI_MakeSolid(TopoDS::Shell(shells.Current())).Solid();
  BRepLib::OrientClosedSolid(solid);
  return solid;
}

}  // namespace

Pair ball_socket(double clearance) {
  Pair p{.name = "ball_socket", .fixed_name = "ball_cup", .moving_name = "ball"};
  p.deviation = 0.03;
  p.fixed = cut(box({-18, -18, -17}, {18, 18, 5}), ball({0, 0, 0}, 12 * (1 + clearance)));
  p.moving = ball({0, 0, 0}, 12);
  p.symmetries = {{.kind = "ball"}};
  return p;
}

Pair hinge(double clearance) {
  Pair p{.name = "hinge", .fixed_name = "hinge_leaf_pin", .moving_name = "hinge_leaf"};
  const double more = 5 * clearance;
  const auto leaf = [](double sign) {
    return sign > 0 ? box({0, 0, -1.5}, {24, 50, 1.5}) : box({-24, 0, -1.5}, {0, 50, 1.5});
  };
  const auto room = [](double low, double high) {
    return cylinder({0, low, 0}, kAlong, 4.5, high - low);
  };
  const auto knuckle = [](double low, double high) {
    return cylinder({0, low, 0}, kAlong, 4, high - low);
  };
  TopoDS_Shape fixed = leaf(1);
  for (const double low : {10.0, 30.0}) fixed = cut(fixed, room(low - more, low + 10 + more));
  fixed = fuse(fixed, knuckle(0, 10 - more));
  fixed = fuse(fixed, knuckle(20 + more, 30 - more));
  fixed = fuse(fixed, knuckle(40 + more, 50));
  fixed = fuse(fixed, cylinder({0, 0, 0}, kAlong, 2 / (1 + clearance), 50));
  for (const double y : {8.0, 40.0}) fixed = cut(fixed, cylinder({15, y, -5}, kUp, 2.5, 10));
  p.fixed = fixed;
  TopoDS_Shape moving = leaf(-1);
  for (const double low : {0.0, 20.0, 40.0})
    moving = cut(moving, room(low == 0.0 ? -1.0 : low, low == 40.0 ? 51.0 : low + 10));
  for (const double low : {10.0, 30.0}) moving = fuse(moving, knuckle(low, low + 10));
  moving = cut(moving, cylinder({0, -1, 0}, kAlong, 2, 52));
  for (const double y : {12.0, 44.0}) moving = cut(moving, cylinder({-17, y, -5}, kUp, 2, 10));
  p.moving = moving;
  // To either stop: the inner edges of a leaf, 4.5 from the axis and 1.5 off its middle plane, meet
  // the other leaf at pi - 2 asin(1.5 / 4.5). The screws' holes do not keep the leaf from lying the
  // other way round, end for end.
  const double stop = pi - 2 * std::asin(1.5 / 4.5);
  p.symmetries = {
      {.kind = "screw", .direction = kAlong, .from = -stop, .to = stop},
      {.kind = "fold", .point = {0, 25, 0}, .direction = Vector3d::UnitX(), .order = 2}};
  return p;
}

Pair spur_gears(double clearance) {
  Pair p{.name = "spur_gears", .fixed_name = "gear_wheel", .moving_name = "gear_pinion"};
  const double tooth = 0.5 * pi * 2;  // half the pitch, module 2
  const Gear wheel{24, 2, tooth * (1 - clearance), 0};
  const Gear pinion{18, 2, tooth, pi + pi / 18};
  p.fixed = cut(fuse(gear_blank(wheel, 8), cylinder({0, 0, -6}, kUp, 11, 6)),
                cylinder({0, 0, -7}, kUp, 6, 20));
  p.moving = cut(gear_blank(pinion, 8), cylinder({0, 0, -1}, kUp, 5, 10));
  p.moving.Move([] {
    gp_Trsf shift;
    shift.SetTranslation(gp_Vec(42, 0, 0));
    return TopLoc_Location(shift);
  }());
  p.symmetries = {
      {.kind = "roll", .moving_point = {42, 0, 0}, .ratio = 24.0 / 18.0},
      {.kind = "fold", .point = {42, 0, 0}, .order = 18},
      {.kind = "fold", .point = {42, 0, 4}, .direction = Vector3d::UnitX(), .order = 2}};
  p.deviation = 0.008;
  return p;
}

Pair thread_nut(double clearance) {
  Pair p{.name = "thread_nut", .fixed_name = "nut", .moving_name = "bolt"};
  p.deviation = 0.04;
  p.angle = 1.2;  // the crests are round on a small scale
  p.smallest = 0.5;
  const auto thread = [](double wide, double low, double high) {
    return thread_solid({8 * wide, 1, 4, low, high});
  };
  p.fixed = cut(regular_prism(6, 13, 0, {0, 0, -6}, 12), thread(1 + clearance, -7.5, 7.5));
  p.moving = fuse(thread(1, -9, 15.5), regular_prism(6, 11, 0, {0, 0, 15}, 8));
  p.symmetries = {{.kind = "fold", .direction = Vector3d::UnitX(), .order = 2},
                  {.kind = "screw", .pitch = 4, .from = -4.5 * pi, .to = 1.5 * pi}};
  return p;
}

}  // namespace mortise::parts_maker
