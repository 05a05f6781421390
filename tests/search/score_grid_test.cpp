// SPDX-License-Identifier: GPL-3.0-or-later
// Scores of all translations against the same Fourier series summed directly, and against the exact
// sum over pairs of balls.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "mortise/affinity/double_skin.hpp"
#include "mortise/core/rotation_vector.hpp"
#include "mortise/kernels/ball.hpp"
#include "mortise/search/rotation_search.hpp"
#include "reference/score_series.hpp"
#include "search/sample_bodies.hpp"

namespace mortise {
namespace {

using namespace sample_bodies;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Root mean square difference over the grid, relative to the scores' own.
template <class Score>
double grid_error(RotationSearch& search, Eigen::Index rotation, const Score& score) {
  const std::vector<float> grid = search.score_grid(rotation);
  const auto [nx, ny, nz] = search.grid_size();
  EXPECT_EQ(grid.size(), static_cast<std::size_t>(nx) * ny * nz);
  double error = 0.0, norm = 0.0;
  std::size_t n = 0;
  for (int i = 0; i < nx; ++i)
    for (int j = 0; j < ny; ++j)
      for (int k = 0; k < nz; ++k, ++n) {
        const double expected = score(search.translation_of(i, j, k));
        error += std::pow(grid[n] - expected, 2);
        norm += expected * expected;
      }
  EXPECT_GT(norm, 0.0);
  return std::sqrt(error / norm);
}

reference::ScoreSeries series(const std::vector<Channel>& channels, const RotationSearch& search,
                              const Eigen::Vector4d& rotation, const SearchOptions& options) {
  const RigidMotion turn{quaternion(rotation), Eigen::Vector3d::Zero()};
  return {
      channels,           search.search_from_fixed(), compose(turn, search.search_from_moving()),
      search.grid_size(), search.spacing(),           options.cutoff};
}

// A smooth transform that is not a ball's, another one per body.
double gaussian(double k, double r) { return std::exp(-std::pow(k * r, 2)); }
double narrow(double k, double r) { return r / (1.0 + std::pow(4.0 * k, 4)); }

// Shape, plus a channel with complex weights and radii of its own on other centres.
std::vector<Channel> channels_of(std::mt19937& random, int kind) {
  const Knots fixed = ellipsoid(random, 60, {18, 10, 3}, {40, -7, 3}, {1.8});
  const Knots moving = ellipsoid(random, 30, {3, 5, 4}, {-4, 50, 9}, {1.8});
  std::vector<Channel> channels = {double_skin_channel(fixed, moving, {1.4, 7.0})};
  if (kind == 0) return channels;
  const Knots f2 = ellipsoid(random, 20, {18, 10, 2}, {40, -7, 3}, {1.0, 2.5, 1.7}, true);
  Knots m2 = ellipsoid(random, 11, {3, 5, 4}, {-4, 50, 9}, {2.2, 0.9}, true);
  m2.points.col(3).head<3>() = moving.points.col(5).head<3>();  // a centre that both channels have
  m2.points.col(4).head<3>() = m2.points.col(7).head<3>();      // and one that occurs twice
  // The shape's scores are some 1e4 times larger without this.
  channels.push_back({"other", 3000.0, f2, m2, gaussian, narrow, 5.0});
  if (kind == 1) return channels;
  return {channels[1]};
}

// Spread width, and error where the window ends at half the Nyquist frequency: from spreading on a
// grid without oversampling, measured at most 1.9e-3, 5.2e-5 and 6.3e-6 (the last single
// precision's; both largest where scores cancel, kind 2), doubled.
struct Accuracy {
  int width;
  double error;
};

TEST(ScoreGrid, EqualsTheTruncatedSeriesTermByTerm) {
  std::mt19937 random(11);
  for (int kind = 0; kind < 3; ++kind)
    for (const Accuracy& a : {Accuracy{4, 4e-3}, Accuracy{6, 1e-4}, Accuracy{8, 1.5e-5}}) {
      const std::vector<Channel> channels = channels_of(random, kind);
      const Eigen::Matrix4Xd rotations = random_rotations(random, 2);
      const SearchOptions options{
          .spacing = 1.6, .cutoff = 0.16, .spread_width = a.width, .radius_tolerance = 1e-6};
      RotationSearch search(channels, rotations, options);
      const auto [nx, ny, nz] = search.grid_size();
      EXPECT_TRUE(nx != ny && ny != nz) << "the box is meant not to be a cube";
      for (int r = 0; r < 2; ++r) {
        const double error =
            grid_error(search, r, series(channels, search, rotations.col(r), options));
        EXPECT_LT(error, a.error) << "kind " << kind << ", width " << a.width;
      }
    }
}

TEST(ScoreGrid, AWindowCutShortByTheGridStaysWithinTheErrorOfSpreading) {
  // The docking default: the window still passes a quarter at the Nyquist frequency, where the
  // spreading kernel aliases most. Every mode is there with its right sign and factor, or the error
  // would be of order 1. Measured 0.06 to 0.084.
  std::mt19937 random(12);
  const std::vector<Channel> channels = channels_of(random, 0);
  const Eigen::Matrix4Xd rotations = random_rotations(random, 3);
  for (const Accuracy& a : {Accuracy{4, 0.12}, Accuracy{8, 0.12}}) {
    const SearchOptions options{.spacing = 3.0, .cutoff = 0.25, .spread_width = a.width};
    RotationSearch search(channels, rotations, options);
    for (int r = 0; r < 3; ++r)
      EXPECT_LT(grid_error(search, r, series(channels, search, rotations.col(r), options)), a.error)
          << a.width;
  }
}

TEST(ScoreGrid, ConvergesToTheSumOfBallOverlaps) {
  // Ball spectra fall as k^-2, so their products' tail and with it the error shrink with the
  // spacing; no window.
  std::mt19937 random(13);
  const Knots fixed = ellipsoid(random, 12, {4, 2, 2}, {5, 5, 5}, {1.8, 2.4});
  const Knots moving = ellipsoid(random, 7, {2, 1, 2}, {0, 0, 9}, {1.5, 2.0});
  const std::vector<Channel> channels = {double_skin_channel(fixed, moving, {1.4, 2.0})};
  const Eigen::Matrix4Xd rotations = random_rotations(random, 1);
  double coarse = 0.0;
  for (const double spacing : {1.4, 0.7, 0.5}) {
    RotationSearch search(channels, rotations,
                          {.spacing = spacing, .cutoff = kInfinity, .spread_width = 8});
    const double error = grid_error(search, 0, [&](const Eigen::Vector3d& t) {
      const Candidate placed{
          0, 0.0F, {static_cast<float>(t[0]), static_cast<float>(t[1]), static_cast<float>(t[2])}};
      return reference::double_skin_score(fixed, moving, search.moving_in_fixed(placed), 1.4, 2.0);
    });
    if (coarse > 0.0) {
      EXPECT_LT(error, 0.6 * coarse);
    } else {
      coarse = error;
    }
    if (spacing == 0.5) {
      EXPECT_LT(error, 0.02);
    }
  }
}

TEST(ScoreGrid, ComplexWeightsPayCoreOnSkin) {
  // Re sum c_i d_j K by pairs: skin on skin +, core on core -, skin on core nothing.
  Knots skin{Eigen::Matrix4Xd(4, 1), Eigen::VectorXcd(1)};
  skin.points << 1.0, 2.0, 3.0, 2.0;
  skin.weights << 1.5;
  Knots core = skin;
  core.weights *= std::complex<double>(0.0, 1.0);
  Knots both = skin;
  both.weights[0] = {1.5, 2.0};
  const auto overlap = [](const Eigen::Vector3d& t) {
    return 1.5 * 1.5 * ball_overlap_volume(2.0, 2.0, t.norm());
  };
  const Eigen::Matrix4Xd identity = Eigen::Vector4d(1, 0, 0, 0);
  const SearchOptions options{.spacing = 0.5, .cutoff = kInfinity, .spread_width = 8};
  const auto search = [&](const Knots& a, const Knots& b) {
    return RotationSearch({{"overlap", 1.0, a, b, ball_transform, ball_transform, 4.0}}, identity,
                          options);
  };
  // Balls cut off at the Nyquist frequency: 1.3% measured.
  RotationSearch pays = search(skin, skin), costs = search(core, core), mixed = search(both, both);
  EXPECT_LT(grid_error(pays, 0, overlap), 0.03);
  EXPECT_LT(grid_error(costs, 0, [&](const auto& t) { return -overlap(t); }), 0.03);
  const double share = (1.5 * 1.5 - 2.0 * 2.0) / (1.5 * 1.5);
  EXPECT_LT(grid_error(mixed, 0, [&](const auto& t) { return share * overlap(t); }), 0.03);
  EXPECT_ANY_THROW((void)search(skin, core));  // no product with a real part is left
}

TEST(ScoreGrid, NoPlacementTouchesTwoCopiesOfTheFixedBody) {
  // Sticks as long as they can be along every axis in turn: a box too short by the range makes the
  // moving one bridge two copies, or reports a contact a box away.
  Knots stick{Eigen::Matrix4Xd(4, 2), Eigen::VectorXcd::Constant(2, 1.0)};
  stick.points << -6.0, 6.0, 0.0, 0.0, 0.0, 0.0, 1.8, 1.8;
  for (const Eigen::Vector3d& axis :
       {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 1, 0), Eigen::Vector3d(0, 0, 1)}) {
    const Eigen::Quaterniond turn = rotation_between(Eigen::Vector3d::UnitX(), axis);
    const Knots fixed = moved({turn, {1, 2, 3}}, stick);
    const std::vector<Channel> channels = {double_skin_channel(fixed, stick, {1.4, 7.0})};
    // Smooth enough a field that the window's blur stays below the tolerance: fine grid, no window.
    // The fixed stick lies along x of the search frame. The spacing leaves a box shorter by the
    // range (30.4) no slack from rounding up to 80 cells.
    RotationSearch search(channels, Eigen::Vector4d(1, 0, 0, 0),
                          {.spacing = 0.3805, .cutoff = kInfinity, .spread_width = 8});
    const std::vector<float> grid = search.score_grid(0);
    const auto [nx, ny, nz] = search.grid_size();
    double scale = 0.0, worst = 0.0;
    std::size_t n = 0;
    for (int i = 0; i < nx; ++i)
      for (int j = 0; j < ny; ++j)
        for (int k = 0; k < nz; ++k, ++n) {
          const Eigen::Vector3f t = search.translation_of(i, j, k).cast<float>();
          const double exact = reference::double_skin_score(
              fixed, stick, search.moving_in_fixed({0, 0.0F, {t[0], t[1], t[2]}}), 1.4, 7.0);
          scale = std::max(scale, exact);
          // Where bodies overlap the cut-off of sharp penalties rings; only contacts are looked at.
          if (exact >= 0.0) worst = std::max(worst, std::abs(grid[n] - exact));
        }
    // Against the best contact, not the far larger penalties: bridging two copies, or missing a
    // contact, is an error of about one pair's best score, half of what both ends touching give.
    EXPECT_LT(worst, 0.25 * scale);
  }
}

}  // namespace
}  // namespace mortise
