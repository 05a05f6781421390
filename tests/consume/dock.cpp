// SPDX-License-Identifier: GPL-3.0-or-later
// The README's example of the library: docks two files and prints the ten best poses.
#include <cstdio>
#include <mortise/molecules/read_molecule.hpp>
#include <mortise/runs/dock.hpp>

int main() {
  const auto read = [](const char* file) {
    return mortise::read_molecule(mortise::parse_molecule_spec(file)).molecule;
  };
  mortise::Docking docking(read("receptor.pdb:A"), read("ligand.pdb"), {.poses = 10});
  docking.search().run();
  const mortise::PoseList list = docking.rank();
  for (const mortise::Pose& pose : list.poses) {
    const mortise::RigidMotion& motion = pose.moving_in_fixed;  // x' = R x + t
    std::printf("%8.3f  angle %.3f  shift %.1f\n", pose.score,
                mortise::rotation_angle(Eigen::Quaterniond::Identity(), motion.rotation),
                motion.translation.norm());
  }
}
