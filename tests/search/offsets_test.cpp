// SPDX-License-Identifier: GPL-3.0-or-later
// Several offsets in one search against separate searches of grown bodies, and against the series
// summed directly.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "mortise/affinity/double_skin.hpp"
#include "mortise/core/errors.hpp"
#include "mortise/search/rotation_search.hpp"
#include "reference/score_series.hpp"
#include "search/sample_bodies.hpp"

namespace mortise {
namespace {

using namespace sample_bodies;

const std::vector<double> kOffsets = {0.0, -0.4, 0.7, 1.4};

Knots grown(Knots knots, double offset) {
  knots.points.row(3).array() += offset;
  return knots;
}

class Offsets : public testing::TestWithParam<bool> {  // radii unequal?
 protected:
  std::mt19937 random{7};
  std::vector<double> radii =
      GetParam() ? std::vector{1.42, 1.61, 1.77, 1.88, 2.6, 3.4} : std::vector{1.8};
  Knots fixed = ellipsoid(random, 90, {13, 8, 6}, {1, 2, 3}, radii);
  Knots moving = ellipsoid(random, 40, {6, 4, 5}, {0, 0, 0}, radii);
  Eigen::Matrix4Xd rotations = random_rotations(random, 12);

  [[nodiscard]] Channel at(double offset) const {
    Channel channel = double_skin_channel(fixed, grown(moving, offset));
    channel.range = double_skin_channel(fixed, moving).range + 1.4;  // boxes of one size
    return channel;
  }
  [[nodiscard]] Channel of_all() const { return double_skin_channel(fixed, moving); }
};

double rms_difference(const std::vector<float>& a, const std::vector<float>& b) {
  double error = 0.0, norm = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    error += std::pow(static_cast<double>(a[i]) - b[i], 2);
    norm += static_cast<double>(b[i]) * b[i];
  }
  return std::sqrt(error / norm);
}

TEST_P(Offsets, GridsAndCandidatesAreThoseOfSeparateSearches) {
  // One radius is exact: the same bytes. Of many, either search compresses within the tolerance,
  // relative to each ball's largest value; where scores cancel, more of it is seen.
  for (const double tolerance : {3e-3, 1e-6}) {
    SearchOptions options{.radius_tolerance = tolerance, .offsets = kOffsets};
    RotationSearch all({of_all()}, rotations, options);
    all.run();
    const std::vector<Candidate> found = all.candidates();
    options.offsets = {0.0};
    for (std::size_t o = 0; o < kOffsets.size(); ++o) {
      RotationSearch one({at(kOffsets[o])}, rotations, options);
      ASSERT_EQ(one.grid_size(), all.grid_size());
      for (const int r : {0, 7}) {
        const std::vector<float> expected = one.score_grid(r);
        const std::vector<float> grid = all.score_grid(r, static_cast<int>(o));
        ASSERT_EQ(grid.size(), expected.size());
        if (GetParam())
          EXPECT_LT(rms_difference(grid, expected), 3.0 * tolerance + 1e-6) << kOffsets[o];
        else
          EXPECT_EQ(grid, expected) << kOffsets[o];
      }
      if (GetParam()) continue;
      one.run();
      const std::vector<Candidate> separate = one.candidates();
      std::vector<Candidate> mine;
      for (const Candidate& c : found)
        if (c.offset_index == static_cast<int>(o)) mine.push_back(c);
      ASSERT_EQ(mine.size(), separate.size());
      for (std::size_t i = 0; i < mine.size(); ++i) {
        EXPECT_EQ(mine[i].rotation_index, separate[i].rotation_index);
        EXPECT_EQ(mine[i].score, separate[i].score);
        EXPECT_EQ(mine[i].translation, separate[i].translation);
      }
    }
    EXPECT_EQ(found.size(), 12U * kOffsets.size() * options.per_rotation);
    EXPECT_TRUE(std::is_sorted(found.begin(), found.end(), [](const auto& a, const auto& b) {
      return std::pair(a.rotation_index, a.offset_index) <
             std::pair(b.rotation_index, b.offset_index);
    }));
  }
}

TEST_P(Offsets, GridsAreTheSeriesOfTheGrownBody) {
  const SearchOptions options{.spacing = 1.6,
                              .cutoff = 0.16,
                              .spread_width = 8,
                              .radius_tolerance = 1e-6,
                              .offsets = kOffsets};
  RotationSearch search({of_all()}, rotations, options);
  const auto [nx, ny, nz] = search.grid_size();
  for (std::size_t o = 0; o < kOffsets.size(); ++o) {
    const RigidMotion turn{quaternion(rotations.col(3)), Eigen::Vector3d::Zero()};
    const reference::ScoreSeries series({at(kOffsets[o])}, search.search_from_fixed(),
                                        compose(turn, search.search_from_moving()),
                                        search.grid_size(), search.spacing(), options.cutoff);
    const std::vector<float> grid = search.score_grid(3, static_cast<int>(o));
    double error = 0.0, norm = 0.0;
    for (int n = 0; n < 300; ++n) {
      const int i = static_cast<int>(random() % nx), j = static_cast<int>(random() % ny),
                k = static_cast<int>(random() % nz);
      const double expected = series(search.translation_of(i, j, k));
      error += std::pow(grid[(static_cast<std::size_t>(i) * ny + j) * nz + k] - expected, 2);
      norm += expected * expected;
    }
    EXPECT_LT(std::sqrt(error / norm), 2e-5) << kOffsets[o];
  }
}

TEST_P(Offsets, ResumeTakesUpCandidatesOfAllOffsets) {
  const SearchOptions options{.per_rotation = 2, .offsets = kOffsets, .threads = 1};
  RotationSearch whole({of_all()}, rotations, options), first({of_all()}, rotations, options);
  whole.run();
  std::vector<std::uint8_t> done = whole.done();
  std::vector<Candidate> some;
  for (std::size_t r = 6; r < done.size(); ++r) done[r] = 0;
  for (const Candidate& c : whole.candidates())
    if (done[c.rotation_index] != 0) some.push_back(c);
  first.resume(done, some);
  first.run();
  const auto a = first.candidates(), b = whole.candidates();
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].score, b[i].score);
    EXPECT_EQ(a[i].offset_index, b[i].offset_index);
  }
  some[0].offset_index = 9;
  EXPECT_THROW(first.resume(done, some), InputError);
}

INSTANTIATE_TEST_SUITE_P(OneRadiusAndMany, Offsets, testing::Bool());

TEST(OffsetsOfASearch, RefusesBadInput) {
  std::mt19937 random(1);
  const std::vector<Channel> channels = {
      double_skin_channel(ellipsoid(random, 9, {3, 2, 1}, {0, 0, 0}, {1.8}),
                          ellipsoid(random, 9, {3, 2, 1}, {0, 0, 0}, {1.8, 1.0}))};
  const Eigen::Matrix4Xd rotations = random_rotations(random, 1);
  EXPECT_THROW(RotationSearch(channels, rotations, {.offsets = {}}), InputError);
  EXPECT_THROW(RotationSearch(channels, rotations, {.offsets = {0.0, NAN}}), InputError);
  EXPECT_THROW(RotationSearch(channels, rotations, {.offsets = {-1.0}}), InputError);
  RotationSearch good(channels, rotations, {.offsets = {-0.9, 0.0}});
  EXPECT_THROW((void)good.score_grid(0, 2), InputError);
  EXPECT_THROW((void)good.score_grid(1, 0), InputError);
}

}  // namespace
}  // namespace mortise
