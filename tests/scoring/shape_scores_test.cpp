// SPDX-License-Identifier: GPL-3.0-or-later
// Scores of given poses against sums over all pairs; what the search's scores miss of the exact
// ones.
#include "mortise/scoring/shape_scores.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "mortise/affinity/double_skin.hpp"
#include "mortise/affinity/sampled_field.hpp"
#include "mortise/core/errors.hpp"
#include "mortise/scoring/shape_kernel.hpp"
#include "mortise/search/rotation_search.hpp"
#include "reference/score_series.hpp"
#include "search/sample_bodies.hpp"

namespace mortise {
namespace {

using namespace sample_bodies;

constexpr DoubleSkinOptions kSkin{.offset = 1.4, .penalty = 7.0};
const std::vector<double> kBallRadii = {1.42, 1.61, 1.77, 1.88, 2.6, 3.4};

Knots enlarged(Knots knots, double offset) {
  knots.points.row(3).array() += offset;
  return knots;
}

std::vector<RigidMotion> touching_poses(std::mt19937& random, int count) {
  std::vector<RigidMotion> poses;
  for (int i = 0; i < count; ++i) {
    RigidMotion pose = random_motion(random, 1.0);
    const Eigen::Vector3d direction = tests::random_vector(random);
    pose.translation = Eigen::Vector3d(1, 2, 3) + (8.0 + 0.4 * i) * direction.normalized();
    poses.push_back(pose);
  }
  return poses;
}

// Root mean square difference relative to the second's own.
double relative(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  return (a - b).norm() / b.norm();
}

class ShapeScores : public testing::Test {
 protected:
  std::mt19937 random{3};
  Knots fixed = ellipsoid(random, 120, {13, 8, 6}, {1, 2, 3}, kBallRadii);
  Knots moving = ellipsoid(random, 50, {6, 4, 5}, {0, 0, 0}, kBallRadii);
  Channel channel = double_skin_channel(fixed, moving, kSkin);
  std::vector<RigidMotion> poses = touching_poses(random, 30);
  std::vector<double> offsets = {0.0, -0.4, 0.5, 1.4};
};

TEST_F(ShapeScores, ExactOnesAreTheCommonVolumesOfTheGrownSkins) {
  const Eigen::MatrixXd scores = exact_scores(channel, poses, {.offsets = offsets});
  for (std::size_t o = 0; o < offsets.size(); ++o) {
    Eigen::VectorXd expected(poses.size());
    for (std::size_t p = 0; p < poses.size(); ++p)
      expected[p] = reference::double_skin_score(fixed, enlarged(moving, offsets[o]), poses[p],
                                                 kSkin.offset, kSkin.penalty);
    // The tables; sums cancel to some extent.
    EXPECT_LT(relative(scores.row(o).transpose(), expected), 3e-5) << offsets[o];
  }
  EXPECT_EQ(scores, exact_scores(channel, poses, {.offsets = offsets, .threads = 1}));
}

TEST_F(ShapeScores, ExactOnesOfComplexWeightsAndGaussians) {
  const Knots a = ellipsoid(random, 40, {9, 6, 6}, {1, 2, 3}, {1.0}, true);
  const Knots b = ellipsoid(random, 30, {6, 4, 5}, {0, 0, 0}, {1.0}, true);
  const Channel nodes = sampled_channel("nodes", 2.5, a, b, 2.0);
  const Eigen::MatrixXd scores = exact_scores(nodes, poses);
  Eigen::VectorXd expected = Eigen::VectorXd::Zero(poses.size());
  for (std::size_t p = 0; p < poses.size(); ++p)
    for (Eigen::Index i = 0; i < a.size(); ++i)
      for (Eigen::Index j = 0; j < b.size(); ++j) {
        const Eigen::Vector3d y = poses[p] * b.points.col(j).head<3>().eval();
        // Gaussians of deviation 1 and integral 8: their product's integral is one of deviation
        // sqrt 2.
        const double k = 64.0 * std::exp(-(a.points.col(i).head<3>() - y).squaredNorm() / 4.0) /
                         std::pow(4.0 * M_PI, 1.5);
        expected[p] += 2.5 * k * (a.weights[i] * b.weights[j]).real();
      }
  EXPECT_LT(relative(scores.row(0).transpose(), expected), 1e-3);  // the range is cut at exp(-9)
}

TEST_F(ShapeScores, LowPassedOnesAreTheSumOverPairsOfLowPassedKernels) {
  const LowPass low_pass{.cutoff = 0.25};
  const ShapeKernels kernels(channel, {.low_pass = low_pass, .offsets = offsets});
  Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(offsets.size(), poses.size());
  for (std::size_t p = 0; p < poses.size(); ++p)
    for (Eigen::Index i = 0; i < fixed.size(); ++i)
      for (Eigen::Index j = 0; j < moving.size(); ++j) {
        const Eigen::Vector3d y = poses[p] * moving.points.col(j).head<3>().eval();
        const double d_sq = (fixed.points.col(i).head<3>() - y).squaredNorm();
        for (std::size_t o = 0; o < offsets.size(); ++o)
          expected(o, p) -= fixed.weights[i].real() * moving.weights[j].real() *
                            kernels.pair(fixed.points(3, i), moving.points(3, j), d_sq, o);
      }
  // The cubics' error falls at least with the third power of the spacing, down to that of tables
  // and single precision.
  double before = 0.0;
  for (const double spacing : {2.0, 1.0, 0.5}) {
    const Eigen::MatrixXd scores = low_passed_scores(
        channel, poses, {.low_pass = low_pass, .offsets = offsets, .spacing = spacing});
    double worst = 0.0;
    for (std::size_t o = 0; o < offsets.size(); ++o)
      worst = std::max(worst, relative(scores.row(o).transpose(), expected.row(o).transpose()));
    if (spacing == 1.0) {
      EXPECT_LT(worst, 2e-3);
    }
    if (before > 0.0) {
      EXPECT_LT(worst, std::max(before / 6.0, 3e-4)) << spacing;
    }
    before = worst;
  }
  EXPECT_EQ(
      low_passed_scores(channel, poses, {.low_pass = low_pass}),
      low_passed_scores(channel, poses, {.low_pass = low_pass, .spacing = 1.0, .threads = 1}));
}

TEST_F(ShapeScores, SensitivityIsTheSlopeOverTheOffset) {
  const double step = 0.05;
  const Eigen::MatrixXd near =
      low_passed_scores(channel, poses, {.low_pass = {.cutoff = 0.25}, .offsets = {-step, step}});
  const Eigen::MatrixXd exact = exact_scores(channel, poses, {.offsets = {-step, step}});
  const Eigen::VectorXd slope = (near.row(1) - near.row(0)).transpose() / (2.0 * step);
  const Eigen::VectorXd sharp = (exact.row(1) - exact.row(0)).transpose() / (2.0 * step);
  // A growing body in contact pays: both fall, about alike; the low-pass blurs.
  EXPECT_GT(slope.dot(sharp) / (slope.norm() * sharp.norm()), 0.9);
}

TEST_F(ShapeScores, TruncationBoundsTheSearchsErrorAtEveryCandidate) {
  const Knots even_fixed = ellipsoid(random, 120, {13, 8, 6}, {1, 2, 3}, {1.8});
  const Knots even_moving = ellipsoid(random, 50, {6, 4, 5}, {0, 0, 0}, {1.8});
  for (const bool many_radii : {false, true})
    for (const double offset : {0.0, 0.7}) {
      const Channel c = many_radii ? channel : double_skin_channel(even_fixed, even_moving, kSkin);
      const Knots& f = many_radii ? fixed : even_fixed;
      const Knots& m = many_radii ? moving : even_moving;
      RotationSearch search({c}, random_rotations(random, 60), {.offsets = {offset}});
      search.run();
      std::vector<RigidMotion> found;
      std::vector<double> scores;
      for (const Candidate& candidate : search.candidates()) {
        found.push_back(search.moving_in_fixed(candidate));
        scores.push_back(candidate.score);
      }
      const std::vector<Truncation> parts =
          score_truncation(c, found, scores, {.low_pass = {.cutoff = 0.25}, .offsets = {offset}});
      double closest = 0.0;
      for (std::size_t p = 0; p < found.size(); ++p) {
        const double exact = reference::double_skin_score(f, enlarged(m, offset), found[p],
                                                          kSkin.offset, kSkin.penalty);
        const double error = std::abs(scores[p] - exact),
                     bound = parts[p].low_pass + parts[p].spread;
        EXPECT_NEAR(parts[p].exact, exact, 1e-4 * std::abs(exact) + 1.0);
        EXPECT_LE(error, bound + 1e-4 * std::abs(exact) + 1.0);
        closest = std::max(closest, error / bound);
      }
      EXPECT_GT(closest, 0.99);  // where both parts have one sign they add up to the error
    }
}

TEST_F(ShapeScores, RefuseBadInput) {
  EXPECT_THROW((void)exact_scores(channel, poses, {.offsets = {}}), InputError);
  EXPECT_THROW((void)exact_scores(channel, poses, {.offsets = {-2.0}}), InputError);
  EXPECT_THROW((void)low_passed_scores(channel, poses, {}), InputError);  // no finite cutoff
  EXPECT_THROW(
      (void)low_passed_scores(channel, poses, {.low_pass = {.cutoff = 0.25}, .spacing = 1e-3}),
      InputError);
  EXPECT_THROW((void)score_truncation(channel, poses, {1.0}, {.low_pass = {.cutoff = 0.25}}),
               InputError);
  channel.pair = nullptr;
  EXPECT_THROW((void)exact_scores(channel, poses), InputError);
}

}  // namespace
}  // namespace mortise
