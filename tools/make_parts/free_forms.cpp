// SPDX-License-Identifier: GPL-3.0-or-later
// Sample pairs without a simple shape: jigsaw, snap hook, bodies broken along a rough surface.
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <Geom_BSplineSurface.hxx>
#include <cmath>
#include <numbers>
#include <random>

#include "pair.hpp"
#include "shapes.hpp"

namespace mortise::parts_maker {
namespace {

using Eigen::Vector3d;

/// A uniform number in [-1, 1); std's distributions differ between libraries, its engines do not.
double uniform(std::mt19937& random) { return static_cast<double>(random()) / 2147483648.0 - 1.0; }

/// Everything below a random surface over the square |x|, |y| < 26: two smooth waves and roughness
/// at every control point of a bicubic B-spline, control points 52 / (n - 3) apart.
TopoDS_Shape below_fracture(unsigned seed, double waves, double roughness) {
  std::mt19937 random(seed);
  constexpr int kPoles = 22;
  constexpr double kHalf = 26;
  constexpr int kSpans = kPoles - 3;
  const auto knot = [&](int i) {
    return -kHalf + 2 * kHalf * std::min(std::max(i, 0), kSpans) / double(kSpans);
  };
  const double phase_1 = uniform(random) * std::numbers::pi;
  const double phase_2 = uniform(random) * std::numbers::pi;
  TColgp_Array2OfPnt poles(1, kPoles, 1, kPoles);
  for (int i = 0; i < kPoles; ++i) {
    for (int j = 0; j < kPoles; ++j) {
      // Greville points: x and y are then exactly the parameters.
      const double x = (knot(i - 2) + knot(i - 1) + knot(i)) / 3;
      const double y = (knot(j - 2) + knot(j - 1) + knot(j)) / 3;
      const double z = waves * (std::sin(0.13 * x + 0.07 * y + phase_1) +
                                0.7 * std::sin(0.19 * y - 0.11 * x + phase_2)) +
                       roughness * uniform(random);
      poles.SetValue(i + 1, j + 1, gp_Pnt(x, y, z));
    }
  }
  TColStd_Array1OfReal knots(1, kSpans + 1);
  TColStd_Array1OfInteger mults(1, kSpans + 1);
  for (int i = 0; i <= kSpans; ++i) {
    knots.SetValue(i + 1, knot(i));
    mults.SetValue(i + 1, i == 0 || i == kSpans ? 4 : 1);
  }
  const Handle(Geom_BSplineSurface) surface =
      new Geom_BSplineSurface(poles, knots, knots, mults, mults, 3, 3);
  return BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(surface, 1e-6).Face(), gp_Vec(0, 0, -60))
      .Shape();
}

}  // namespace

Pair jigsaw(double clearance) {
  Pair p{.name = "jigsaw", .fixed_name = "jigsaw_left", .moving_name = "jigsaw_right"};
  const auto knob = [](double side, double y, double scale) {
    const double end = 7 * side;
    return fuse(box({std::min(end, 0.0) - 0.5, y - 2.5 * scale, 0},
                    {std::max(end, 0.0) + 0.5, y + 2.5 * scale, 6}),
                cylinder({end, y, 0}, kUp, 5 * scale, 6));
  };
  const double wide = 1 + clearance;
  const TopoDS_Shape left = box({-30, -20, 0}, {0, 20, 6});
  const TopoDS_Shape right = box({0, -20, 0}, {34, 20, 6});
  p.fixed = fuse(cut(left, knob(-1, 9, wide)), knob(1, -8, 1 / wide));
  p.moving = cut(fuse(right, knob(-1, 9, 1)), knob(1, -8, 1));
  return p;
}

Pair snap_hook(double clearance) {
  Pair p{.name = "snap_hook", .fixed_name = "snap_plate", .moving_name = "snap_cover"};
  const double more = 1.5 * clearance;
  TopoDS_Shape plate = box({-22, -12, 2 * more}, {22, 12, 3});
  plate = cut(plate, box({-14 - more, -5 - more, -1}, {-9, 3 + more, 4}));
  p.fixed = cut(plate, box({9, -1 - more, -1}, {14 + more, 5 + more, 4}));
  const auto hook = [](double sign, double low, double high) {
    return prism({{sign * 11, low, 4},
                  {sign * 11, low, -4},
                  {sign * 14, low, -4},
                  {sign * 15.5, low, -0.5},
                  {sign * 15.5, low, 0},
                  {sign * 14, low, 0},
                  {sign * 14, low, 4}},
                 {0, high - low, 0});
  };
  p.moving = fuse(fuse(box({-20, -12, 3}, {24, 12, 8}), hook(-1, -5, 3)), hook(1, -1, 5));
  return p;
}

Pair broken_block(double /*clearance*/) {
  Pair p{.name = "broken_block",
         .fixed_name = "broken_block_lower",
         .moving_name = "broken_block_upper"};
  const TopoDS_Shape block = box({-20, -16, -16}, {20, 16, 18});
  const TopoDS_Shape lower = below_fracture(1, 2.5, 1.4);
  p.fixed = common(block, lower);
  p.moving = cut(block, lower);
  p.deviation = 0.06;
  return p;
}

Pair broken_sphere(double /*clearance*/) {
  Pair p{.name = "broken_sphere",
         .fixed_name = "broken_sphere_lower",
         .moving_name = "broken_sphere_upper"};
  const TopoDS_Shape lower = below_fracture(2, 2, 1.4);
  p.fixed = common(ball({0, 0, 0}, 20), lower);
  p.moving = cut(ball({0, 0, 0}, 20), lower);
  p.deviation = 0.06;
  return p;
}

}  // namespace mortise::parts_maker
