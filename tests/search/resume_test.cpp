// SPDX-License-Identifier: GPL-3.0-or-later
// The rotation loop as a whole: threads, stopping and resuming, progress, refusals.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "mortise/affinity/double_skin.hpp"
#include "mortise/core/errors.hpp"
#include "mortise/search/rotation_search.hpp"
#include "search/sample_bodies.hpp"

namespace mortise {
namespace {

using namespace sample_bodies;

class RotationLoop : public testing::Test {
 protected:
  std::mt19937 random{21};
  Knots fixed = ellipsoid(random, 80, {14, 9, 7}, {3, 2, 1}, {1.8});
  Knots moving = ellipsoid(random, 40, {6, 8, 5}, {9, 9, 9}, {1.8});
  std::vector<Channel> channels = {double_skin_channel(fixed, moving)};
  Eigen::Matrix4Xd rotations = random_rotations(random, 300);
  SearchOptions options{.threads = 1};

  static bool same_bytes(const std::vector<Candidate>& a, const std::vector<Candidate>& b) {
    return a.size() == b.size() &&
           (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(Candidate)) == 0);
  }
  std::vector<Candidate> all() {
    RotationSearch search(channels, rotations, options);
    EXPECT_TRUE(search.run());
    return search.candidates();
  }
};

TEST_F(RotationLoop, SameBytesForAnyNumberOfThreads) {
  const std::vector<Candidate> one = all();
  EXPECT_GE(one.size(), 300U);
  for (const int threads : {1, 2, 5}) {
    options.threads = threads;
    EXPECT_TRUE(same_bytes(all(), one)) << threads;
  }
}

TEST_F(RotationLoop, CandidatesComeByRotationBestFirstInsideTheBox) {
  RotationSearch search(channels, rotations, options);
  EXPECT_TRUE(search.candidates().empty());
  EXPECT_EQ(std::count(search.done().begin(), search.done().end(), 0), 300);
  EXPECT_TRUE(search.run());
  EXPECT_EQ(std::count(search.done().begin(), search.done().end(), 1), 300);
  const std::vector<Candidate> found = search.candidates();
  std::vector<int> count(300, 0);
  for (std::size_t i = 0; i < found.size(); ++i) {
    ++count.at(found[i].rotation_index);
    if (i > 0 && found[i].rotation_index == found[i - 1].rotation_index) {
      EXPECT_LE(found[i].score, found[i - 1].score) << i;
    } else if (i > 0) {
      EXPECT_EQ(found[i].rotation_index, found[i - 1].rotation_index + 1);
    }
    for (int d = 0; d < 3; ++d)
      EXPECT_LE(std::abs(found[i].translation[d]),
                (0.5 * search.grid_size()[d] + 0.51) * search.spacing());
  }
  for (const int c : count) EXPECT_EQ(c, options.per_rotation);
}

TEST_F(RotationLoop, StopsAndResumesWithTheSameBytes) {
  const std::vector<Candidate> whole = all();
  options.threads = 2;
  for (const std::size_t stop : {1, 40, 200}) {
    RotationSearch first(channels, rotations, options);
    std::size_t last = 0;
    EXPECT_FALSE(first.run([&](std::size_t done, std::size_t total) {
      EXPECT_EQ(total, 300U);
      EXPECT_GT(done, last);
      last = done;
      return done < stop;
    }));
    EXPECT_EQ(static_cast<std::size_t>(std::count(first.done().begin(), first.done().end(), 1)),
              last);
    EXPECT_GE(last, stop);
    EXPECT_LT(last, 300U);
    // Taken up by another search, and gone on with by itself.
    RotationSearch second(channels, rotations, options);
    second.resume(first.done(), first.candidates());
    EXPECT_TRUE(same_bytes(second.candidates(), first.candidates()));
    std::size_t begin = 0;
    EXPECT_TRUE(second.run([&](std::size_t done, std::size_t) {
      if (begin == 0) begin = done;
      return true;
    }));
    EXPECT_GT(begin, last);  // what was done is counted and not done again
    EXPECT_TRUE(same_bytes(second.candidates(), whole)) << stop;
    EXPECT_TRUE(first.run());
    EXPECT_TRUE(same_bytes(first.candidates(), whole));
  }
}

TEST_F(RotationLoop, ResumesFromAnySetOfRotationsAndForgetsItsOwn) {
  RotationSearch whole(channels, rotations, options);
  whole.run();
  std::vector<std::uint8_t> done(300, 0);
  std::vector<Candidate> kept;
  for (int r = 0; r < 300; ++r) done[r] = r % 7 == 3 || r > 290 ? 1 : 0;
  for (const Candidate& c : whole.candidates())
    if (done[c.rotation_index] == 1) kept.push_back(c);
  RotationSearch other(channels, rotations, options);
  int calls = 0;
  other.run([&](std::size_t, std::size_t) { return ++calls < 2; });
  other.resume(done, kept);
  EXPECT_TRUE(same_bytes(other.candidates(), kept));
  EXPECT_EQ(other.done(), done);
  EXPECT_TRUE(other.run());
  EXPECT_TRUE(same_bytes(other.candidates(), whole.candidates()));
}

TEST_F(RotationLoop, ProgressRisesToTheTotalAndAStopAtTheEndIsNoStop) {
  RotationSearch search(channels, rotations, options);
  std::size_t last = 0;
  EXPECT_TRUE(search.run([&](std::size_t done, std::size_t total) {
    EXPECT_GT(done, last);
    EXPECT_LE(done, total);
    last = done;
    return done < total;
  }));
  EXPECT_EQ(last, 300U);
  EXPECT_TRUE(search.run([](std::size_t, std::size_t) { return false; }));  // nothing left to do
}

TEST_F(RotationLoop, ResumeRefusesWhatDoesNotFitAndChangesNothing) {
  RotationSearch search(channels, rotations, options);
  search.run();
  const std::vector<Candidate> good = search.candidates();
  const std::vector<std::uint8_t> done(300, 1);
  const auto refused = [&](const std::vector<std::uint8_t>& d, const std::vector<Candidate>& c) {
    try {
      search.resume(d, c);
      return false;
    } catch (const InputError&) {
      return same_bytes(search.candidates(), good) && search.done() == done;
    }
  };
  EXPECT_TRUE(refused(std::vector<std::uint8_t>(299, 0), {}));
  EXPECT_TRUE(refused(done, {}));                                 // candidates are missing
  EXPECT_TRUE(refused(done, {good.begin(), good.end() - 4}));     // of the last rotation
  EXPECT_TRUE(refused(std::vector<std::uint8_t>(300, 0), good));  // of rotations not done
  std::vector<Candidate> bad = good;
  bad[7].rotation_index = -1;
  EXPECT_TRUE(refused(done, bad));
  bad[7].rotation_index = 300;
  EXPECT_TRUE(refused(done, bad));
  bad = good;
  bad.push_back(good[0]);  // a fifth
  EXPECT_TRUE(refused(done, bad));
}

TEST_F(RotationLoop, RefusesBadInput) {
  const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
  const auto refused = [&](const SearchOptions& o) {
    try {
      (void)RotationSearch(channels, rotations, o);
    } catch (const InputError&) {
      return true;
    }
    return false;
  };
  EXPECT_FALSE(refused(options));
  for (const double bad : {0.0, -1.0, nan, infinity, 1e-3}) EXPECT_TRUE(refused({.spacing = bad}));
  for (const double bad : {0.0, -1.0, nan}) EXPECT_TRUE(refused({.cutoff = bad}));
  for (const int bad : {0, -3}) EXPECT_TRUE(refused({.per_rotation = bad}));
  for (const double bad : {-1.0, nan}) EXPECT_TRUE(refused({.separation = bad}));
  for (const int bad : {1, 9}) EXPECT_TRUE(refused({.spread_width = bad}));
  EXPECT_TRUE(refused({.threads = -1}));
  EXPECT_THROW(RotationSearch({}, rotations), InputError);
  EXPECT_THROW(RotationSearch(channels, Eigen::Matrix4Xd(4, 0)), InputError);
  EXPECT_THROW(RotationSearch(channels, 1.1 * rotations), InputError);
  EXPECT_THROW(RotationSearch(channels, Eigen::Matrix4Xd::Constant(4, 1, nan)), InputError);
  std::vector<Channel> bad = channels;
  bad[0].weight = nan;
  EXPECT_THROW(RotationSearch(bad, rotations), InputError);
  bad = channels;
  bad[0].moving.weights.setZero();
  EXPECT_THROW(RotationSearch(bad, rotations), InputError);
  bad = channels;
  bad[0].weight = 0.0;
  EXPECT_THROW(RotationSearch(bad, rotations), InputError);
}

TEST_F(RotationLoop, AnInfiniteSeparationKeepsOneTranslation) {
  options.separation = std::numeric_limits<double>::infinity();
  EXPECT_EQ(all().size(), 300U);
}

TEST_F(RotationLoop, SmallestBodiesAndGrids) {
  Knots point{Eigen::Matrix4Xd(4, 1), Eigen::VectorXcd::Constant(1, 1.0)};
  point.points << 100.0, -200.0, 300.0, 1.0;
  // Weight -1 on the moving body: overlap pays, so the best pose lies on top of the other.
  Knots minus = point;
  minus.weights *= -1.0;
  for (const double spacing : {0.5, 1.0, 5.0, 50.0}) {
    RotationSearch search({double_skin_channel(point, minus, {1.0, 3.0})},
                          Eigen::Vector4d(1, 0, 0, 0), {.spacing = spacing, .cutoff = 0.4});
    EXPECT_TRUE(search.run());
    const std::vector<Candidate> found = search.candidates();
    ASSERT_FALSE(found.empty());
    for (const int n : search.grid_size()) EXPECT_GE(n, 4);
    if (spacing > 1.0) continue;
    const Eigen::Vector3d at =
        search.moving_in_fixed(found[0]) * point.points.col(0).head<3>().eval();
    EXPECT_LT((at - point.points.col(0).head<3>()).norm(), 0.1 * spacing);
  }
}

}  // namespace
}  // namespace mortise
