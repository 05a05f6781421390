// SPDX-License-Identifier: GPL-3.0-or-later
// Mating of small parts: the energy's derivatives, polish, the search as a whole, determinism.
#include "mortise/search/mate.hpp"

#include <gtest/gtest.h>

#include "metrics/bodies.hpp"
#include "mortise/core/errors.hpp"
#include "mortise/metrics/placement.hpp"
#include "search/voxel_parts.hpp"

namespace mortise {
namespace {

using testing::mortise_block;
using testing::tenon_plate;
using testing_bodies::random_motion;

MateOptions small_options() {
  MateOptions options;
  options.rotations = 600;
  options.spacing = 0.06;
  options.detail = 0.03;
  options.samples = 1000;
  options.polished = 60;
  options.poses = 10;
  return options;
}

TEST(Mating, FindsTheTenonInItsMortiseFromARandomStart) {
  std::mt19937 random(11);
  const RigidMotion start = random_motion(random, 2.5, 10.0);
  const MatePart moving = tenon_plate(start);
  Mating mating(mortise_block(), moving, small_options());
  ASSERT_TRUE(mating.search().run());
  const PoseList list = mating.rank();
  ASSERT_FALSE(list.poses.empty());
  TrueMate truth;
  truth.moving_in_fixed = inverse(start);
  const Placement placement(moving.mesh, truth);
  for (std::size_t i = 0; i < list.poses.size(); ++i)
    std::printf("%zu %.4f = %.4f %.4f  error %.4f\n", i, list.poses[i].score,
                list.poses[i].channels[0], list.poses[i].channels[1],
                placement.error(list.poses[i].moving_in_fixed).largest);
  EXPECT_LT(placement.error(list.poses.front().moving_in_fixed).largest, 0.01);
}

}  // namespace
}  // namespace mortise
