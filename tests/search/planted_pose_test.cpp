// SPDX-License-Identifier: GPL-3.0-or-later
// Frames: a pose that is known beforehand, and what must not change when bodies are moved or
// swapped.
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

struct Pair {
  Knots fixed, moving;
};

// A block of jittered points 3 apart with a box cut out of its side: the box, and the block less
// the points within `gap` of the box.
Pair cut_block(std::mt19937& random) {
  std::uniform_real_distribution<double> jitter(-0.4, 0.4);
  std::vector<Eigen::Vector3d> fixed, moving;
  const Eigen::Vector3d low(-2.0, -7.0, -5.0), high(12.0, 4.0, 3.0);
  for (int i = -5; i <= 5; ++i)
    for (int j = -4; j <= 4; ++j)
      for (int k = -3; k <= 3; ++k) {
        const Eigen::Vector3d p{3.0 * i + jitter(random), 3.0 * j + jitter(random),
                                3.0 * k + jitter(random)};
        const Eigen::Vector3d out = (low - p).cwiseMax(p - high).cwiseMax(0.0);
        if (out.norm() == 0.0)
          moving.push_back(p);
        else
          fixed.push_back(p);
      }
  const auto knots = [](const std::vector<Eigen::Vector3d>& p) {
    Knots result{Eigen::Matrix4Xd(4, p.size()), Eigen::VectorXcd::Constant(p.size(), 1.0)};
    for (std::size_t n = 0; n < p.size(); ++n) result.points.col(n) << p[n], 1.8;
    return result;
  };
  return {knots(fixed), knots(moving)};
}

const Candidate& best_of(const std::vector<Candidate>& found) {
  return *std::max_element(found.begin(), found.end(),
                           [](const auto& a, const auto& b) { return a.score < b.score; });
}

double distance(const RigidMotion& a, const RigidMotion& b, const Knots& body) {
  const Eigen::Matrix3Xd points = body.points.topRows<3>();
  return std::sqrt((a * points - b * points).colwise().squaredNorm().mean());
}

// The row of a rotation set at which the search meets `pose`.
Eigen::Vector4d row_for(const RotationSearch& search, const RigidMotion& pose) {
  return row_of(search.search_from_fixed().rotation * pose.rotation);
}

class Planted : public testing::Test {
 protected:
  std::mt19937 random{31};
  Pair pair = cut_block(random);
  DoubleSkinOptions skin{1.4, 12.0};
  SearchOptions options{.spacing = 1.0, .cutoff = 0.7, .spread_width = 6, .threads = 2};

  RotationSearch search_at(const Knots& fixed, const Knots& moving, const RigidMotion& pose,
                           int others = 0) {
    const std::vector<Channel> channels = {double_skin_channel(fixed, moving, skin)};
    const RotationSearch frames(channels, Eigen::Vector4d(1, 0, 0, 0), options);
    Eigen::Matrix4Xd rotations(4, others + 1);
    rotations << random_rotations(random, others), row_for(frames, pose);
    RotationSearch search(channels, rotations, options);
    EXPECT_TRUE(search.run());
    return search;
  }
};

TEST_F(Planted, ThePieceGoesHome) {
  const RotationSearch search = search_at(pair.fixed, pair.moving, {}, 60);
  const Candidate best = best_of(search.candidates());
  EXPECT_EQ(best.rotation_index, 60);
  // The score's own maximum need not be home to the digit: the points are jittered.
  const RigidMotion pose = search.moving_in_fixed(best);
  EXPECT_LT(distance(pose, {}, pair.moving), 0.5 * options.spacing);
  EXPECT_LT(rotation_angle(pose.rotation, Eigen::Quaterniond::Identity()), 1e-6);
  // Home is far better than anything else: all sides of the socket touch.
  for (const Candidate& c : search.candidates())
    if (c.rotation_index != 60) {
      EXPECT_LT(c.score, 0.8F * best.score);
    }
}

TEST_F(Planted, APieceThatWasCarriedAwayGoesHomeByTheInverseMotion) {
  for (int repeat = 0; repeat < 3; ++repeat) {
    const RigidMotion away = random_motion(random, 80.0);
    const Knots moving = moved(away, pair.moving);
    const RotationSearch search = search_at(pair.fixed, moving, inverse(away), 20);
    const Candidate best = best_of(search.candidates());
    EXPECT_EQ(best.rotation_index, 20);
    EXPECT_LT(distance(search.moving_in_fixed(best), inverse(away), moving), 0.5 * options.spacing);
  }
}

TEST_F(Planted, MovingBothBodiesMovesThePosesAndKeepsTheScores) {
  const RigidMotion home;
  const RotationSearch before = search_at(pair.fixed, pair.moving, home);
  const Candidate a = best_of(before.candidates());
  for (int repeat = 0; repeat < 4; ++repeat) {
    const RigidMotion f = random_motion(random, 30.0), m = random_motion(random, 70.0);
    const RotationSearch after =
        search_at(moved(f, pair.fixed), moved(m, pair.moving), compose(f, inverse(m)));
    // The search frame depends on the fixed body's shape alone.
    const RigidMotion frame = compose(after.search_from_fixed(), f);
    EXPECT_LT(rotation_angle(frame.rotation, before.search_from_fixed().rotation), 1e-6);
    EXPECT_LT((frame.translation - before.search_from_fixed().translation).norm(), 1e-6);
    const Candidate b = best_of(after.candidates());
    // The moving body's centre, so the grid's place, differs a little: sub-grid error remains.
    EXPECT_NEAR(b.score, a.score, 0.01 * a.score);
    const RigidMotion back = compose(inverse(f), compose(after.moving_in_fixed(b), m));
    EXPECT_LT(distance(back, before.moving_in_fixed(a), pair.moving), 0.1 * options.spacing);
  }
}

TEST_F(Planted, ShiftingABodyShiftsAllPoses) {
  const RotationSearch before = search_at(pair.fixed, pair.moving, {});
  const RigidMotion shift{Eigen::Quaterniond::Identity(), {11.0, -23.0, 5.0}};
  const RotationSearch by_moving = search_at(pair.fixed, moved(shift, pair.moving), {});
  const RotationSearch by_fixed = search_at(moved(shift, pair.fixed), pair.moving, {});
  const std::vector<Candidate> a = before.candidates(), b = by_moving.candidates(),
                               c = by_fixed.candidates();
  ASSERT_EQ(a.size(), 4U);
  ASSERT_EQ(b.size(), 4U);
  ASSERT_EQ(c.size(), 4U);
  for (int i = 0; i < 4; ++i) {
    // Same grid, same place: rounding of the input coordinates is all that differs, through single
    // precision scores.
    EXPECT_NEAR(b[i].score, a[i].score, 1e-4 * a[0].score);
    EXPECT_NEAR(c[i].score, a[i].score, 1e-4 * a[0].score);
    const RigidMotion pose = before.moving_in_fixed(a[i]);
    EXPECT_LT(distance(compose(by_moving.moving_in_fixed(b[i]), shift), pose, pair.moving), 1e-2);
    EXPECT_LT(distance(by_fixed.moving_in_fixed(c[i]), compose(shift, pose), pair.moving), 1e-2);
  }
}

TEST_F(Planted, SwappedBodiesGiveTheInversePose) {
  const RigidMotion away = random_motion(random, 40.0);
  const Knots moving = moved(away, pair.moving);
  const RotationSearch straight = search_at(pair.fixed, moving, inverse(away));
  const RotationSearch swapped = search_at(moving, pair.fixed, away);
  const Candidate a = best_of(straight.candidates()), b = best_of(swapped.candidates());
  // Two grids, two directions of spreading: 2% and 0.13 of the spacing measured on another sample.
  // A wrong frame is off by the body's size.
  EXPECT_NEAR(b.score, a.score, 0.05 * a.score);
  EXPECT_LT(distance(inverse(swapped.moving_in_fixed(b)), straight.moving_in_fixed(a), moving),
            0.3 * options.spacing);
}

TEST_F(Planted, TheWindowedScoreIsNearTheExactPairSum) {
  // Not equal, the window blurs: but of its size, and of its sign where bodies overlap.
  const RotationSearch search = search_at(pair.fixed, pair.moving, {});
  const double exact =
      reference::double_skin_score(pair.fixed, pair.moving, {}, skin.offset, skin.penalty);
  EXPECT_NEAR(best_of(search.candidates()).score, exact, 0.35 * exact);
}

}  // namespace
}  // namespace mortise
