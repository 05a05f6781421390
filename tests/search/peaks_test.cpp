// SPDX-License-Identifier: GPL-3.0-or-later
// Best translations at one rotation: apart, sorted, and at the series' true maxima.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "mortise/affinity/double_skin.hpp"
#include "mortise/search/rotation_search.hpp"
#include "reference/score_series.hpp"
#include "search/sample_bodies.hpp"

namespace mortise {
namespace {

using namespace sample_bodies;

Eigen::Vector3d translation(const Candidate& c) {
  return {c.translation[0], c.translation[1], c.translation[2]};
}

// Distance between nearest copies in the periodic box.
double apart(const Candidate& a, const Candidate& b, const RotationSearch& search) {
  Eigen::Vector3d step = translation(a) - translation(b);
  for (int d = 0; d < 3; ++d) {
    const double side = search.grid_size()[d] * search.spacing();
    step[d] -= side * std::round(step[d] / side);
  }
  return step.norm();
}

class Peaks : public testing::Test {
 protected:
  std::mt19937 random{41};
  Knots fixed = ellipsoid(random, 120, {12, 9, 6}, {1, 2, 3}, {1.8});
  Knots moving = ellipsoid(random, 50, {6, 4, 5}, {0, 0, 0}, {1.8});
  std::vector<Channel> channels = {double_skin_channel(fixed, moving)};
  Eigen::Matrix4Xd rotations = random_rotations(random, 40);
};

TEST_F(Peaks, AreApartSortedAndAsManyAsAsked) {
  for (const double spacing : {3.0, 2.0})
    for (const double separation : {0.0, 2.9, 5.0, 8.0, 15.0})
      for (const int per_rotation : {1, 4, 9}) {
        RotationSearch search(
            channels, rotations,
            {.spacing = spacing, .per_rotation = per_rotation, .separation = separation});
        search.run();
        const std::vector<Candidate> found = search.candidates();
        EXPECT_EQ(found.size(), 40U * per_rotation);
        for (std::size_t i = 0; i < found.size(); ++i)
          for (std::size_t j = i + 1; j < found.size(); ++j) {
            if (found[i].rotation_index != found[j].rotation_index) continue;
            EXPECT_GE(found[i].score, found[j].score);
            // Translations are stored in single precision.
            EXPECT_GE(apart(found[i], found[j], search), separation - 1e-4)
                << spacing << ' ' << separation;
          }
      }
}

TEST_F(Peaks, MoreAreNotThereThanTheBoxHolds) {
  RotationSearch search(channels, rotations.leftCols(2), {.per_rotation = 500, .separation = 15.0});
  search.run();
  EXPECT_LT(search.candidates().size(), 1000U);
  EXPECT_GT(search.candidates().size(), 10U);
}

TEST_F(Peaks, BestIsTheGridsMaximumOrAboveIt) {
  RotationSearch search(channels, rotations, {.per_rotation = 1});
  search.run();
  const std::vector<Candidate> found = search.candidates();
  for (int r = 0; r < 40; ++r) {
    const std::vector<float> grid = search.score_grid(r);
    const float top = *std::max_element(grid.begin(), grid.end());
    EXPECT_GE(found[r].score, top);
    EXPECT_LE(found[r].score, 1.3F * top);
  }
}

TEST_F(Peaks, SubGridPositionIsTheSeriesMaximum) {
  const SearchOptions options{
      .spacing = 1.5, .cutoff = 0.2, .per_rotation = 2, .separation = 6.0, .spread_width = 6};
  RotationSearch search(channels, rotations, options);
  search.run();
  const std::vector<Candidate> found = search.candidates();
  double worst = 0.0, worst_on_grid = 0.0, score_error = 0.0;
  int compared = 0;
  for (int r = 0; r < 6; ++r) {
    const Candidate& c = found[2 * r];
    const reference::ScoreSeries score(
        channels, search.search_from_fixed(),
        compose({quaternion(rotations.col(r)), Eigen::Vector3d::Zero()},
                search.search_from_moving()),
        search.grid_size(), search.spacing(), options.cutoff);
    // Climb to the maximum: a pattern search whose steps halve.
    Eigen::Vector3d top = translation(c);
    double best = score(top);
    for (double step = 0.4; step > 0.01;) {
      const Eigen::Vector3d from = top;
      for (int d = 0; d < 3; ++d)
        for (const double sign : {-1.0, 1.0}) {
          const Eigen::Vector3d t = from + sign * step * Eigen::Vector3d::Unit(d);
          const double s = score(t);
          if (s > best) {
            best = s;
            top = t;
          }
        }
      if (top == from) step *= 0.5;
    }
    worst = std::max(worst, (top - translation(c)).norm());
    score_error = std::max(score_error, std::abs(c.score - best) / best);
    double nearest = 1e9;  // grid point
    const auto [nx, ny, nz] = search.grid_size();
    for (int i = 0; i < nx; ++i)
      for (int j = 0; j < ny; ++j)
        for (int k = 0; k < nz; ++k)
          nearest = std::min(nearest, (search.translation_of(i, j, k) - top).norm());
    worst_on_grid = std::max(worst_on_grid, nearest);
    ++compared;
  }
  EXPECT_EQ(compared, 6);
  // A parabola per axis through a band-limited function: a seventh of the spacing at worst, where
  // the grid alone is off by half of it; scores to 1%.
  EXPECT_LT(worst, 0.15 * options.spacing);
  EXPECT_GT(worst_on_grid, 0.3 * options.spacing);
  EXPECT_LT(score_error, 0.01);
}

}  // namespace
}  // namespace mortise
