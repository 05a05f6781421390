// SPDX-License-Identifier: GPL-3.0-or-later
// What a maker of sample parts hands over: two solids in mated position and what may move.
#pragma once

#include <Eigen/Core>
#include <TopoDS_Shape.hxx>
#include <string>
#include <vector>

namespace mortise::parts_maker {

/// One family of motions that keep the pair mated; the frame of the mated pair, radians and mm.
struct Symmetry {
  std::string kind;  ///< turn, fold, screw, slide, ball, roll; see parts/README.md
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();
  int order = 0;       ///< fold
  double pitch = 0.0;  ///< screw
  double from = 0.0;   ///< screw: angle, slide: length
  double to = 0.0;
  Eigen::Vector3d moving_point = Eigen::Vector3d::Zero();  ///< roll
  Eigen::Vector3d moving_direction = Eigen::Vector3d::UnitZ();
  double ratio = 0.0;
};

struct Pair {
  std::string name;         ///< of the pair, without the clearance
  std::string fixed_name;   ///< stem of the fixed part, without the clearance
  std::string moving_name;  ///< stem of the moving part, the same at every clearance
  TopoDS_Shape fixed = {};  ///< in mated position, mm; carries all of the clearance
  TopoDS_Shape moving = {};
  std::vector<Symmetry> symmetries = {};
  double deviation = 0.02;  ///< of the STL files, mm
  double angle = 0.35;      ///< largest turn of their normals, radians
  double smallest = 0.0;    ///< length below which no edge of them is split, mm
};

// Each takes the clearance as a part of the feature's size: the fixed part's hole is 1 + clearance
// times as wide as what goes in (its peg 1 / (1 + clearance) times as wide as what it goes into).
Pair round_peg(double clearance);
Pair square_peg(double clearance);
Pair hex_key(double clearance);
Pair taper(double clearance);
Pair three_pegs(double clearance);
Pair mortise_tenon(double clearance);
Pair dovetail(double clearance);
Pair t_slot(double clearance);
Pair tongue_groove(double clearance);
Pair key_keyway(double clearance);
Pair cross_lap(double clearance);
Pair finger_joint(double clearance);
Pair ball_socket(double clearance);
Pair hinge(double clearance);
Pair spur_gears(double clearance);
Pair thread_nut(double clearance);
Pair jigsaw(double clearance);
Pair snap_hook(double clearance);
Pair broken_block(double clearance);
Pair broken_sphere(double clearance);

}  // namespace mortise::parts_maker
