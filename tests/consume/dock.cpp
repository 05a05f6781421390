// SPDX-License-Identifier: GPL-3.0-or-later
// The README's example of the library: docks two files and prints the ten best poses.
#include <cstdio>
#include <mortise/runs/dock.hpp>

int main() {
  const mortise::Run run = mortise::dock(mortise::read_body("receptor.pdb:A"),
                                         mortise::read_body("ligand.pdb"), {.poses = 10});
  for (const mortise::Pose& pose : run.poses.poses) {
    const mortise::RigidMotion& motion = pose.moving_in_fixed;  // x' = R x + t
    std::printf("%8.3f  angle %.3f  shift %.1f\n", pose.score,
                mortise::rotation_angle(Eigen::Quaterniond::Identity(), motion.rotation),
                motion.translation.norm());
  }
}
