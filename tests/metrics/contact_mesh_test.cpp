// SPDX-License-Identifier: GPL-3.0-or-later
// Penetration volume and depth of sample parts against the intersection of their meshes.
#include <gtest/gtest.h>

#include "mortise/metrics/contact.hpp"
#include "mortise/metrics/true_mates.hpp"
#include "mortise/parts/diameter.hpp"
#include "mortise/parts/mesh_solid.hpp"
#include "mortise/parts/read_part.hpp"
#include "reference/mesh_overlap.hpp"

namespace mortise {
namespace {

TriangleMesh read(const std::string& stem) {
  return read_part(MORTISE_SOURCE_DIR "/parts/" + stem + ".stl",
                   {.repair = {.find_self_intersections = false}})
      .mesh;
}

TEST(ContactOfMeshesSlow, IsThatOfTheirIntersection) {
  const std::vector<TrueMate> mates = read_true_mates(MORTISE_SOURCE_DIR "/parts/mates.json");
  for (const char* name : {"mortise_tenon_close", "dovetail_close", "broken_block_exact",
                           "ball_socket_loose", "spur_gears_close", "jigsaw_close"}) {
    const TrueMate mate = find_true_mate(mates, "", "", name);
    const TriangleMesh fixed = read(mate.fixed);
    const TriangleMesh moving = read(mate.moving);
    const MeshSolid fixed_solid(fixed);
    const MeshSolid moving_solid(moving);
    const double unit = std::min(diameter_of(fixed.vertices), diameter_of(moving.vertices));
    for (const double share : {0.02, 0.08}) {
      // Into the fixed part, along no face, and a little askew.
      RigidMotion off;
      off.rotation = Eigen::AngleAxisd(0.5 * share, Eigen::Vector3d(2, -1, 3).normalized());
      const Eigen::Vector3d middle = mate.moving_in_fixed * moving_solid.bounds().center().eval();
      const Eigen::Vector3d inwards =
          (fixed_solid.bounds().center() - middle) / unit + Eigen::Vector3d(1, 2, -2) / 10.0;
      off.translation = middle - off.rotation * middle + share * unit * inwards.normalized();
      const RigidMotion pose = compose(off, mate.moving_in_fixed);
      TriangleMesh placed = moving;
      placed.vertices = pose * moving.vertices;
      const reference::MeshOverlap expected = reference::mesh_overlap(fixed, placed);
      ASSERT_GT(expected.volume, 0.0) << name;
      const ContactReport found = measure_contact(fixed, fixed_solid, moving, moving_solid, pose);
      // Leaves are 0.015 wide: of an overlap hardly deeper, edges cross most.
      EXPECT_NEAR(found.penetration_volume, expected.volume,
                  (share > 0.05 ? 0.04 : 0.2) * expected.volume)
          << name << ' ' << share;
      // Both sample the surface.
      EXPECT_NEAR(found.penetration_depth, expected.depth, 0.04 * expected.depth)
          << name << ' ' << share;
    }
  }
}

}  // namespace
}  // namespace mortise
