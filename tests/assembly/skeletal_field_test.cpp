// SPDX-License-Identifier: GPL-3.0-or-later
// Energy of skeletal densities: what makes contact hard or soft [HA, Sec. 2.3 and 4.3].
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "mortise/assembly/assembly_session.hpp"
#include "mortise/assembly/part_field.hpp"
#include "mortise/core/errors.hpp"
#include "mortise/parts/mesh_solid.hpp"
#include "parts/shapes.hpp"

namespace mortise {
namespace {

// Two boxes of 2 x 2 x 1, one pushed down on the other along z: they touch at height 1.
struct Press {
  double rest = 0.0;      // height of least energy
  double depth = 0.0;     // -energy there
  double hardness = 0.0;  // largest force that pushes them apart
  double overlap = 0.0;   // energy at height 0.5, half of each inside the other
  double slope_error = 0.0;
};

AssemblySession session(int modes, double sigma, double penalty) {
  const MeshSolid box(shapes::box({2.0, 2.0, 1.0}));
  const BodyDensity field = skeletal_field(box, {.grid = 24, .sigma = sigma, .penalty = penalty});
  return {field, field, {.modes = modes}};
}

Press press(int modes, double sigma, double penalty) {
  const AssemblySession parts = session(modes, sigma, penalty);
  constexpr double kStep = 0.02;
  std::vector<Wrench> felt;
  for (int i = 0; i <= 75; ++i)
    felt.push_back(parts.wrench({Eigen::Quaterniond::Identity(), {0.0, 0.0, 0.5 + kStep * i}}));
  Press result;
  result.overlap = felt.front().energy;
  double least = 0.0, largest = 0.0;
  for (std::size_t i = 0; i < felt.size(); ++i) {
    if (felt[i].energy < least) {
      least = felt[i].energy;
      result.rest = 0.5 + kStep * static_cast<double>(i);
    }
    result.hardness = std::max(result.hardness, felt[i].force[2]);
    largest = std::max(largest, std::abs(felt[i].force[2]));
    if (i == 0 || i + 1 == felt.size()) continue;
    const double slope = (felt[i + 1].energy - felt[i - 1].energy) / (2.0 * kStep);
    result.slope_error = std::max(result.slope_error, std::abs(slope + felt[i].force[2]));
  }
  result.depth = -least;
  result.slope_error /= largest;
  return result;
}

TEST(SkeletalField, PartsAttractAtContactAndRepelWhereTheyOverlap) {
  const Press boxes = press(4000, 0.5, 3.0);
  EXPECT_GT(boxes.rest, 0.7);
  EXPECT_LT(boxes.rest, 1.1);
  EXPECT_GT(boxes.depth, 0.0);
  EXPECT_GT(boxes.overlap, boxes.depth);
  EXPECT_LT(boxes.slope_error, 0.02);  // single precision, and the difference's own error
  const AssemblySession parts = session(4000, 0.5, 3.0);
  const double far = 0.98 * parts.reach();
  EXPECT_LT(std::abs(parts.wrench({Eigen::Quaterniond::Identity(), {0.0, 0.0, far}}).energy),
            0.03 * boxes.depth);
}

TEST(SkeletalField, MoreModesMakeContactHarder) {
  const Press soft = press(200, 0.5, 3.0), firm = press(1000, 0.5, 3.0),
              hard = press(4000, 0.5, 3.0);
  EXPECT_GT(firm.hardness, 2.0 * soft.hardness);
  EXPECT_GT(hard.hardness, 1.1 * firm.hardness);
  EXPECT_GT(soft.rest, 1.3);  // blurred cores hold the parts off
  EXPECT_LT(hard.rest, 1.0);
}

TEST(SkeletalField, ThinnerSkeletonsMakeContactHarder) {
  const Press soft = press(4000, 1.0, 3.0), firm = press(4000, 0.5, 3.0),
              hard = press(4000, 0.2, 3.0);
  EXPECT_GT(firm.hardness, 1.4 * soft.hardness);
  EXPECT_GT(hard.hardness, 1.1 * firm.hardness);
  EXPECT_GT(firm.rest, soft.rest);
  EXPECT_GE(hard.rest, firm.rest);
}

TEST(SkeletalField, APenaltyKeepsPartsFromSinkingIntoEachOther) {
  const Press none = press(4000, 0.5, 1.0), some = press(4000, 0.5, 3.0),
              much = press(4000, 0.5, 6.0);
  EXPECT_LT(none.overlap, 0.0);  // with equal weights half of each inside the other still pays
  EXPECT_GT(some.overlap, 0.0);
  EXPECT_GT(much.overlap, 3.0 * some.overlap);
  EXPECT_GT(some.rest, none.rest + 0.1);
  EXPECT_GE(much.rest, some.rest);
  EXPECT_GT(much.hardness, 2.0 * some.hardness);
}

TEST(SkeletalField, RefusesBadInput) {
  const MeshSolid box(shapes::box({2.0, 2.0, 1.0}));
  EXPECT_THROW((void)skeletal_field(box, {.grid = 4}), InputError);
  EXPECT_THROW((void)skeletal_field(box, {.margin = -1.0}), InputError);
  EXPECT_THROW((void)skeletal_field(box, {.penalty = 0.0}), InputError);
}

}  // namespace
}  // namespace mortise
