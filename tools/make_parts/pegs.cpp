// SPDX-License-Identifier: GPL-3.0-or-later
// Sample pairs: pegs of several shapes in holes.
#include <BRepPrimAPI_MakeTorus.hxx>
#include <cmath>
#include <numbers>

#include "pair.hpp"
#include "shapes.hpp"

namespace mortise::parts_maker {
namespace {

using Eigen::Vector3d;

/// A round rail of radius `minor` along an arc in the plane z = centre.z, with balls at its ends.
TopoDS_Shape curved_rail(const Vector3d& centre, double major, double minor, double from,
                         double to) {
  const gp_Ax2 frame(gp_Pnt(centre.x(), centre.y(), centre.z()), gp_Dir(0, 0, 1),
                     gp_Dir(std::cos(from), std::sin(from), 0));
  const TopoDS_Shape arc = BRepPrimAPI_MakeTorus(frame, major, minor, to - from).Solid();
  const auto end = [&](double angle) {
    return ball(centre + major * Vector3d(std::cos(angle), std::sin(angle), 0), minor);
  };
  return fuse(fuse(arc, end(from)), end(to));
}

}  // namespace

Pair round_peg(double clearance) {
  Pair p{.name = "round_peg", .fixed_name = "round_peg_hole", .moving_name = "round_peg_pin"};
  const Vector3d bottom(15, 12, 6);
  p.fixed = cut(box({0, 0, 0}, {40, 30, 20}), cylinder(bottom, kUp, 5 * (1 + clearance), 20));
  p.moving = fuse(cylinder(bottom, kUp, 5, 14), cylinder({15, 12, 20}, kUp, 8, 5));
  p.symmetries = {{.kind = "turn", .point = bottom}};
  return p;
}

Pair square_peg(double clearance) {
  Pair p{.name = "square_peg", .fixed_name = "square_peg_hole", .moving_name = "square_peg_pin"};
  const Vector3d bottom(24, 13, 7);
  const double turn = 0.35;
  p.fixed =
      cut(box({0, 0, 0}, {40, 30, 20}), regular_prism(4, 4.5 * (1 + clearance), turn, bottom, 20));
  p.moving =
      fuse(regular_prism(4, 4.5, turn, bottom, 13), regular_prism(4, 7, turn, {24, 13, 20}, 5));
  p.symmetries = {{.kind = "fold", .point = bottom, .order = 4}};
  return p;
}

Pair hex_key(double clearance) {
  Pair p{.name = "hex_key", .fixed_name = "hex_key_socket", .moving_name = "hex_key_bar"};
  p.fixed = cut(fuse(cylinder({0, 0, 0}, kUp, 10, 14), cylinder({0, 0, -20}, kUp, 6, 20)),
                regular_prism(6, 4 * (1 + clearance), 0, {0, 0, 7}, 20));
  p.moving = regular_prism(6, 4, 0, {0, 0, 7}, 40);
  p.symmetries = {
      {.kind = "fold", .order = 6},
      {.kind = "fold", .point = {0, 0, 27}, .direction = Vector3d::UnitX(), .order = 2}};
  return p;
}

Pair taper(double clearance) {
  Pair p{.name = "taper", .fixed_name = "taper_sleeve", .moving_name = "taper_plug"};
  const double wide = 1 + clearance;
  p.fixed = cut(box({-14, -12, 0}, {18, 15, 26}), cone({0, 0, 4}, 5 * wide, 8 * wide, 22));
  p.moving = fuse(cone({0, 0, 4}, 5, 8, 22), cylinder({0, 0, 26}, kUp, 8, 10));
  p.symmetries = {{.kind = "turn"}};
  return p;
}

// After the pair of [HA, Fig. 4] as its text describes it: plane, cylindrical, spherical and
// toroidal patches, three pegs and holes, and curved features that fit along a part of their
// length.
Pair three_pegs(double clearance) {
  Pair p{.name = "three_pegs", .fixed_name = "three_pegs_base", .moving_name = "three_pegs_cover"};
  const double wide = 1 + clearance;
  const double degree = std::numbers::pi / 180;
  const Vector3d arc(30, 4, 20);
  TopoDS_Shape base = box({0, 0, 0}, {60, 40, 20});
  base = cut(base, cylinder({8, 10, 10}, kUp, 3 * wide, 20));
  base = cut(base, cylinder({52, 10, 8}, kUp, 4 * wide, 20));
  base = cut(base, cylinder({36, 32, 12}, kUp, 2.5 * wide, 20));
  base = cut(base, curved_rail(arc, 18, 3 * wide, 40 * degree, 140 * degree));
  p.fixed = fuse(base, ball({12, 30, 20}, 4 / wide));
  TopoDS_Shape cover = box({2, 2, 20}, {58, 38, 28});
  cover = fuse(cover, cylinder({8, 10, 10}, kUp, 3, 12));
  cover = fuse(cover, cylinder({52, 10, 8}, kUp, 4, 14));
  cover = fuse(cover, cylinder({36, 32, 12}, kUp, 2.5, 10));
  cover = fuse(cover, curved_rail(arc, 18, 3, 40 * degree, 110 * degree));
  p.moving = cut(cover, ball({12, 30, 20}, 4));
  return p;
}

}  // namespace mortise::parts_maker
