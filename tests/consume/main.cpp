// SPDX-License-Identifier: GPL-3.0-or-later
// Calls the installed library: composes two motions and catches one of its errors.
#include <cmath>
#include <cstdio>
#include <mortise/core/errors.hpp>
#include <mortise/core/knots.hpp>
#include <mortise/core/rigid_motion.hpp>
#include <mortise/core/version.hpp>
#include <numbers>

int main() {
  using std::numbers::pi;
  const Eigen::Quaterniond eighth_turn(Eigen::AngleAxisd(pi / 4, Eigen::Vector3d::UnitZ()));
  const mortise::RigidMotion quarter =
      mortise::compose({.rotation = eighth_turn}, {.rotation = eighth_turn});
  const double angle =
      mortise::rotation_angle(Eigen::Quaterniond::Identity(), quarter.rotation) * 180 / pi;
  try {
    mortise::check_knots(mortise::Knots{}, "consumer");
  } catch (const mortise::InputError&) {  // crosses the library's border with its type
    std::printf("mortise %s: angle %.0f\n", mortise::kVersion, angle);
    return 0;
  }
  return 1;
}
