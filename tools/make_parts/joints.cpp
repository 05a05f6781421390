// SPDX-License-Identifier: GPL-3.0-or-later
// Sample pairs: joints of wood and metal with plane faces.
#include "pair.hpp"
#include "shapes.hpp"

namespace mortise::parts_maker {
namespace {

using Eigen::Vector3d;

/// A bar along x with half-round ends: centre, overall length, width, from z `low` to `high`.
TopoDS_Shape round_ended_bar(double x, double length, double width, double low, double high) {
  const double half = 0.5 * (length - width);
  const TopoDS_Shape middle = box({x - half, -0.5 * width, low}, {x + half, 0.5 * width, high});
  const TopoDS_Shape left = cylinder({x - half, 0, low}, kUp, 0.5 * width, high - low);
  const TopoDS_Shape right = cylinder({x + half, 0, low}, kUp, 0.5 * width, high - low);
  return fuse(fuse(middle, left), right);
}

}  // namespace

Pair mortise_tenon(double clearance) {
  Pair p{.name = "mortise_tenon", .fixed_name = "mortise_post", .moving_name = "tenon_rail"};
  const double wide = 1 + clearance;
  p.fixed = cut(box({0, 0, 0}, {24, 24, 80}),
                box({9, 12 - 4 * wide, 30 - 10 * wide}, {30, 12 + 4 * wide, 30 + 10 * wide}));
  p.moving = fuse(box({24, 4, 16}, {80, 20, 44}), box({9, 8, 20}, {30, 16, 40}));
  p.symmetries = {
      {.kind = "fold", .point = {24, 12, 30}, .direction = Vector3d::UnitX(), .order = 2}};
  return p;
}

// One flank leans and one is upright, and the groove ends inside the block: one pose only.
Pair dovetail(double clearance) {
  Pair p{.name = "dovetail", .fixed_name = "dovetail_socket", .moving_name = "dovetail_tail"};
  const double more = 8 * clearance;
  const auto tail = [](double widen, double front) {
    return prism({{-10 - widen, front, 8},
                  {8 + widen, front, 8},
                  {8 + widen, front, 16},
                  {-6 - widen, front, 16}},
                 {0, 30 - front, 0});
  };
  // The groove's prism starts before the block, so that its mouth is cut cleanly.
  TopoDS_Shape groove = tail(more, -5);
  p.fixed = cut(box({-20, 0, 0}, {20, 40, 16}), groove);
  p.moving = fuse(box({-20, 0, 16}, {20, 30, 26}), tail(0, 0));
  return p;
}

Pair t_slot(double clearance) {
  Pair p{.name = "t_slot", .fixed_name = "t_slot_table", .moving_name = "t_slot_nut"};
  const double wide = 1 + clearance;
  p.fixed = cut(box({-25, -30, 0}, {25, 30, 20}),
                fuse(box({-8 * wide, -31, 12 - 8 * wide}, {8 * wide, 31, 12}),
                     box({-4 * wide, -31, 12}, {4 * wide, 31, 21})));
  p.moving = fuse(box({-8, -7, 4}, {8, 7, 12}), box({-4, -7, 12}, {4, 7, 24}));
  p.symmetries = {{.kind = "slide", .direction = Vector3d::UnitY(), .from = -23, .to = 23},
                  {.kind = "fold", .order = 2}};
  return p;
}

Pair tongue_groove(double clearance) {
  Pair p{.name = "tongue_groove", .fixed_name = "groove_board", .moving_name = "tongue_board"};
  const double more = 2 * clearance;
  p.fixed = cut(box({-30, 0, 0}, {0, 60, 12}), box({-6, -1, 3 - more}, {1, 61, 7 + more}));
  p.moving = fuse(box({0, 0, 0}, {30, 60, 12}), box({-6, 0, 3}, {0, 60, 7}));
  return p;
}

Pair key_keyway(double clearance) {
  Pair p{.name = "key_keyway", .fixed_name = "keyway_shaft", .moving_name = "key"};
  p.fixed = cut(cylinder({-40, 0, 0}, Vector3d::UnitX(), 12, 80),
                round_ended_bar(10, 24 + 8 * clearance, 8 * (1 + clearance), 8, 20));
  p.moving = round_ended_bar(10, 24, 8, 8, 15);
  p.symmetries = {
      {.kind = "fold", .point = {10, 0, 0}, .order = 2},
      {.kind = "fold", .point = {10, 0, 11.5}, .direction = Vector3d::UnitX(), .order = 2}};
  return p;
}

Pair cross_lap(double clearance) {
  Pair p{.name = "cross_lap", .fixed_name = "cross_lap_lower", .moving_name = "cross_lap_upper"};
  const double half = 6 * (1 + clearance);
  const double side = 6 / (1 + clearance);
  p.fixed = cut(box({-30, -side, 0}, {30, side, 12}), box({-half, -7, 6}, {half, 7, 13}));
  p.moving = cut(box({-6, -34, 0}, {6, 34, 12}), box({-7, -6, -1}, {7, 6, 6}));
  p.symmetries = {{.kind = "fold", .order = 2}};
  return p;
}

Pair finger_joint(double clearance) {
  Pair p{.name = "finger_joint", .fixed_name = "finger_wall", .moving_name = "finger_floor"};
  const double more = 5 * clearance;
  TopoDS_Shape wall = box({0, 0, 0}, {6, 50, 30});
  wall = cut(wall, box({-1, 10 - more, -1}, {7, 20 + more, 6}));
  p.fixed = cut(wall, box({-1, 30 - more, -1}, {7, 40 + more, 6}));
  p.moving = fuse(fuse(box({6, 0, 0}, {42, 50, 6}), box({0, 10, 0}, {7, 20, 6})),
                  box({0, 30, 0}, {7, 40, 6}));
  p.symmetries = {
      {.kind = "fold", .point = {3, 25, 0}, .order = 2},
      {.kind = "fold", .point = {0, 25, 3}, .direction = Vector3d::UnitX(), .order = 2}};
  return p;
}

}  // namespace mortise::parts_maker
