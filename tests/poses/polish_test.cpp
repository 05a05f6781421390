// SPDX-License-Identifier: GPL-3.0-or-later
// Polish: shape kernel against overlap volumes and the search's grid, scores by maps against pair
// sums, the climb against known tops.
#include "mortise/poses/polish.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "mortise/affinity/double_skin.hpp"
#include "mortise/core/errors.hpp"
#include "mortise/core/pose_distance.hpp"
#include "mortise/core/rotation_vector.hpp"
#include "mortise/kernels/ball.hpp"
#include "mortise/molecules/contact_types.hpp"
#include "mortise/scoring/shape_kernel.hpp"
#include "mortise/search/rotation_search.hpp"
#include "search/sample_bodies.hpp"

namespace mortise {
namespace {

constexpr double kRadius = 1.8;
const LowPass kWindow{.cutoff = 0.25};

// Two bodies with shape and types at about protein density, and their score by pairs.
struct Case {
  Knots fixed, moving;
  TypedPoints fixed_typed, moving_typed;
  ContactPotential potential = fitted_contact_potential();
  TabulatedKernel kernel;

  explicit Case(std::uint32_t seed) {
    std::mt19937 random(seed);
    fixed = sample_bodies::ellipsoid(random, 500, {15.0, 13.0, 11.0}, {4.0, 0.0, -3.0}, {kRadius});
    moving = sample_bodies::ellipsoid(random, 250, {11.0, 9.0, 10.0}, {-2.0, 5.0, 1.0}, {kRadius});
    std::uniform_int_distribution<int> type(-1, kContactTypes - 1);
    for (const auto& [knots, typed] :
         {std::pair{&fixed, &fixed_typed}, std::pair{&moving, &moving_typed}}) {
      typed->points = knots->points.topRows<3>();
      typed->types.resize(knots->size());
      for (int& t : typed->types) t = type(random);
    }
    kernel = shape_kernel(double_skin_channel(fixed, moving), kRadius, kRadius, kWindow);
  }

  [[nodiscard]] double shape_by_pairs(const RigidMotion& pose) const {
    double sum = 0.0;
    for (Eigen::Index i = 0; i < fixed.size(); ++i)
      for (Eigen::Index j = 0; j < moving.size(); ++j) {
        const Eigen::Vector3d at = pose * moving.points.col(j).head<3>().eval();
        sum -= fixed.weights[i].real() * moving.weights[j].real() *
               kernel((fixed.points.col(i).head<3>() - at).squaredNorm());
      }
    return sum;
  }
  [[nodiscard]] ScoreMaps maps(double spacing, int threads = 1) const {
    return {fixed_typed,
            potential,
            shape_terms(fixed.points.topRows<3>(), -potential.shape * fixed.weights.real(), kernel),
            {.spacing = spacing, .threads = threads}};
  }
  [[nodiscard]] PlacedPoints placed() const {
    return {moving_typed, moving.points.topRows<3>(), moving.weights.real().transpose()};
  }
  // The moving body's centre at `distance` from the fixed body's, turned at random.
  [[nodiscard]] RigidMotion near_by(double distance, std::mt19937& random) const {
    RigidMotion pose = sample_bodies::random_motion(random, 1.0);
    const Eigen::Vector3d centre =
        fixed.points.topRows<3>().rowwise().mean() + distance * pose.translation.normalized();
    pose.translation = centre - pose.rotation * moving.points.topRows<3>().rowwise().mean();
    return pose;
  }
};

// Small turn `w` about the moved centre and shift `t`.
RigidMotion nudged(const RigidMotion& pose, const Eigen::Vector3d& centre, const Eigen::Vector3d& t,
                   const Eigen::Vector3d& w) {
  RigidMotion result{rotation_from_vector(w) * pose.rotation, {}};
  result.translation = pose * centre + t - result.rotation * centre;
  return result;
}

TEST(ShapeKernel, WithoutALowPassIsTheOverlapOfTheDoubleSkins) {
  const Knots one{Eigen::Vector4d(0.0, 0.0, 0.0, 1.8), Eigen::VectorXcd::Ones(1)};
  const Knots two{Eigen::Vector4d(0.0, 0.0, 0.0, 1.5), Eigen::VectorXcd::Ones(1)};
  const double lambda = 7.0, r0 = 1.4;
  const Channel channel = double_skin_channel(one, two, {.offset = r0, .penalty = lambda});
  const TabulatedKernel kernel = shape_kernel(channel, 1.8, 1.5, {.cutoff = 6.0, .pass = 3.0});
  double largest = 0.0;
  for (double d = 0.05; d < 8.0; d += 0.1) {
    const auto v = [&](double a, double b) { return ball_overlap_volume(a, b, d); };
    const double exact = lambda * lambda * v(1.8, 1.5) - lambda * v(1.8 + r0, 1.5) -
                         lambda * v(1.8, 1.5 + r0) + v(1.8 + r0, 1.5 + r0);
    largest = std::max(largest, std::abs(exact));
    EXPECT_NEAR(kernel(d * d), exact, 0.003 * 600.0) << d;  // the window's edge; largest is > 500
  }
  EXPECT_GT(largest, 500.0);
  EXPECT_EQ(kernel(1e4), 0.0);
}

// The low-pass ends at half the grid's Nyquist frequency, so that spreading errs by 5e-5
// (score_grid_test). The rest, 3%, is the kernel's cut tail: with 2.5 / cutoff more range instead
// of 1.15 it is 1.2%. A wrong sign, frame or factor would be 100%.
TEST(ShapeKernel, PairSumIsTheSearchsScore) {
  const Case c(1);
  std::mt19937 random(2);
  RotationSearch search({double_skin_channel(c.fixed, c.moving)},
                        sample_bodies::random_rotations(random, 2),
                        {.spacing = 1.0, .per_rotation = 1, .spread_width = 6, .threads = 1});
  ASSERT_TRUE(search.run());
  double error = 0.0, size = 0.0;
  const std::vector<float> grid = search.score_grid(0);
  const auto [nx, ny, nz] = search.grid_size();
  for (int n = 0; n < 200; ++n) {
    const int i = static_cast<int>(random() % nx), j = static_cast<int>(random() % ny),
              k = static_cast<int>(random() % nz);
    const Eigen::Vector3f t = search.translation_of(i, j, k).cast<float>();
    const double exact = c.shape_by_pairs(search.moving_in_fixed({0, 0.0F, {t[0], t[1], t[2]}}));
    error += std::pow(grid[(static_cast<std::size_t>(i) * ny + j) * nz + k] - exact, 2);
    size += exact * exact;
  }
  EXPECT_LT(std::sqrt(error / size), 0.05);
}

TEST(ShapeKernel, RefusesBadInput) {
  const Case c(1);
  const Channel channel = double_skin_channel(c.fixed, c.moving);
  EXPECT_THROW((void)shape_kernel(channel, 1.8, 1.8, {}), InputError);  // no finite cutoff
  EXPECT_THROW((void)shape_kernel(channel, 0.0, 1.8, kWindow), InputError);
}

TEST(PlacedPoints, SharedPlacesBecomeOneEntry) {
  TypedPoints typed{Eigen::Matrix3Xd(3, 3), Eigen::Vector3i(4, -1, 2)};
  typed.points << 0, 1, 2, 0, 0, 0, 0, 0, 0;
  Eigen::Matrix3Xd shape(3, 3);
  shape << 0, 1, 5, 0, 0, 0, 0, 0, 0;
  const PlacedPoints placed(typed, shape, Eigen::RowVector3d(0.5, 0.25, 2.0));
  EXPECT_EQ(placed.centre, Eigen::Vector3d(2.0, 0.0, 0.0));
  EXPECT_DOUBLE_EQ(placed.gyration, std::sqrt(14.0 / 3.0));
  EXPECT_EQ(placed.largest_type, 4);
  ASSERT_EQ(placed.places.rows(), 16);  // one group
  // Typed and knot, knot alone, typed alone, knot alone; the rest has no weight.
  const auto entry = [&](float x, int type, float contact, float weight) {
    int found = 0;
    for (int n = 0; n < 16; ++n)
      found += placed.places(n, 0) == x && placed.types[n] == type &&
               placed.contact_weights[n] == contact && placed.shape_weights(n, 0) == weight;
    return found;
  };
  EXPECT_EQ(entry(-2.0F, 4, 1.0F, 0.5F), 1);
  EXPECT_EQ(entry(-1.0F, 0, 0.0F, 0.25F), 1);
  EXPECT_EQ(entry(0.0F, 2, 1.0F, 0.0F), 1);
  EXPECT_EQ(entry(3.0F, 0, 0.0F, 2.0F), 1);
  EXPECT_EQ(placed.contact_weights.sum(), 2.0F);
  EXPECT_EQ(placed.shape_weights.sum(), 2.75F);
  EXPECT_THROW(PlacedPoints(typed, shape, Eigen::RowVector2d(1.0, 1.0)), InputError);
}

TEST(ScoreSlope, ApproachesThePairSumWithFinerSpacing) {
  const Case c(3);
  std::mt19937 random(4);
  std::vector<RigidMotion> poses;
  for (int i = 0; i < 25; ++i) poses.push_back(c.near_by(18.0 + 0.4 * i, random));
  double previous_shape = 0.0, previous_contact = 0.0;
  for (const double spacing : {2.0, 1.0, 0.5}) {
    const ScoreMaps maps = c.maps(spacing);
    double shape_error = 0.0, shape_size = 0.0, contact_error = 0.0, contact_size = 0.0;
    for (const RigidMotion& pose : poses) {
      const auto [shape, contact] = maps.terms(c.placed(), pose);
      const double s = c.potential.shape * c.shape_by_pairs(pose);
      const double t = contact_score(c.fixed_typed, c.moving_typed, pose, c.potential);
      shape_error += (shape - s) * (shape - s);
      shape_size += s * s;
      contact_error += (contact - t) * (contact - t);
      contact_size += t * t;
    }
    const double s = std::sqrt(shape_error / shape_size);
    const double t = std::sqrt(contact_error / contact_size);
    if (spacing == 1.0) {
      EXPECT_LT(s, 0.05);
      EXPECT_LT(t, 0.04);
    }
    if (spacing < 2.0) {
      EXPECT_LT(s, 0.4 * previous_shape) << spacing;    // smooth kernel
      EXPECT_LT(t, 0.6 * previous_contact) << spacing;  // kernels with corners
    }
    previous_shape = s;
    previous_contact = t;
  }
}

TEST(ScoreSlope, NothingFarAwayAndErrors) {
  const Case c(7);
  std::mt19937 random(8);
  EXPECT_EQ(c.maps(1.0).slope(c.placed(), c.near_by(80.0, random)).value, 0.0);
  const ScoreMaps bare(c.fixed_typed, c.potential, {.threads = 1});
  EXPECT_THROW((void)bare.slope(c.placed(), {}), InputError);
  TypedPoints typed = c.moving_typed;
  typed.types[0] = kContactTypes;
  const PlacedPoints placed(typed, c.moving.points.topRows<3>(),
                            c.moving.weights.real().transpose());
  EXPECT_THROW((void)c.maps(1.0).slope(placed, {}), InputError);
  EXPECT_THROW(
      ScoreMaps(c.fixed_typed, c.potential,
                shape_terms(c.fixed.points.topRows<3>(), Eigen::VectorXd::Ones(3), c.kernel)),
      InputError);
}

// Minus the mean square distance of the body's points from where `top` puts them: its only maximum
// up to half a turn is `top`, and it is not quadratic in the rotation.
struct Hill {
  Eigen::Matrix3Xd points;
  RigidMotion top;
  Eigen::Vector3d centre = points.rowwise().mean();

  PlacedScore operator()(const RigidMotion& pose) const {
    const Eigen::Matrix3Xd at = pose * points, gap = (top * points) - at;
    PlacedScore score;
    score.value = -gap.squaredNorm() / static_cast<double>(points.cols());
    score.force = 2.0 * gap.rowwise().mean();
    for (Eigen::Index i = 0; i < points.cols(); ++i)
      score.torque +=
          2.0 / static_cast<double>(points.cols()) * (at.col(i) - pose * centre).cross(gap.col(i));
    return score;
  }
};

TEST(Polish, ClimbsToTheTopOfAHill) {
  std::mt19937 random(9);
  const Knots body = sample_bodies::ellipsoid(random, 60, {20.0, 12.0, 7.0}, {30, -8, 2}, {1.0});
  const PoseDistance distance(body.points.topRows<3>());
  for (int n = 0; n < 10; ++n) {
    const Hill hill{body.points.topRows<3>(), sample_bodies::random_motion(random, 10.0)};
    const double gyration = std::sqrt((hill.points.colwise() - hill.centre).squaredNorm() / 60.0);
    const RigidMotion start =
        nudged(hill.top, hill.centre, {1.0, -2.0, 0.5}, Eigen::Vector3d(0.1, 0.15, -0.1));
    const auto polished =
        polish_poses(hill, {hill.centre, gyration}, {start},
                     {.evaluations = 40, .longest_step = 3.0, .tolerance = 1e-3, .threads = 1});
    EXPECT_GT(distance.rmsd(start, hill.top), 2.0);
    EXPECT_LT(distance.rmsd(polished[0].moving_in_fixed, hill.top), 1e-2);
    EXPECT_LE(polished[0].evaluations, 40);
    EXPECT_DOUBLE_EQ(polished[0].score, hill(polished[0].moving_in_fixed).value);
    EXPECT_DOUBLE_EQ(polished[0].start, hill(start).value);
  }
}

TEST(Polish, NeverEndsLowerAndNeitherThreadsNorOthersMatter) {
  const Case c(10);
  const ScoreMaps maps = c.maps(1.0);
  const PlacedPoints placed = c.placed();
  std::mt19937 random(11);
  std::vector<RigidMotion> poses;
  for (int i = 0; i < 40; ++i) poses.push_back(c.near_by(19.0 + 0.2 * i, random));
  const PoseObjective objective = [&](const RigidMotion& m) { return maps.slope(placed, m); };
  const PolishBody body{placed.centre, placed.gyration};
  const auto one = polish_poses(objective, body, poses, {.threads = 1});
  const auto two = polish_poses(objective, body, poses, {.threads = 2});
  int higher = 0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    EXPECT_EQ(one[i].start, maps.slope(placed, poses[i]).value);
    EXPECT_EQ(one[i].score, maps.slope(placed, one[i].moving_in_fixed).value);
    EXPECT_GE(one[i].score, one[i].start);
    higher += one[i].score > one[i].start + 0.1 * std::abs(one[i].start);
    EXPECT_EQ(one[i].score, two[i].score);
    EXPECT_EQ(one[i].moving_in_fixed.rotation.coeffs(), two[i].moving_in_fixed.rotation.coeffs());
    EXPECT_EQ(one[i].moving_in_fixed.translation, two[i].moving_in_fixed.translation);
    const auto alone = polish_poses(objective, body, {poses[i]}, {.threads = 1});
    EXPECT_EQ(alone[0].score, one[i].score);
  }
  EXPECT_GT(higher, 30);
}

TEST(Polish, AFlatScoreAndASingleEvaluationLeaveThePoseAlone) {
  const RigidMotion pose{Eigen::Quaterniond(0.5, 0.5, 0.5, 0.5), {1.0, 2.0, 3.0}};
  const PoseObjective flat = [](const RigidMotion&) { return PlacedScore{}; };
  const PoseObjective slope = [](const RigidMotion& m) {
    return PlacedScore{m.translation[0], Eigen::Vector3d::UnitX(), Eigen::Vector3d::Zero()};
  };
  const PolishBody body{Eigen::Vector3d::Zero(), 10.0};
  EXPECT_EQ(polish_poses(flat, body, {pose})[0].moving_in_fixed.translation, pose.translation);
  const auto one = polish_poses(slope, body, {pose}, {.evaluations = 1});
  EXPECT_EQ(one[0].moving_in_fixed.translation, pose.translation);
  EXPECT_EQ(one[0].evaluations, 1);
  // Up a plane it goes on, by the first step once and no farther than the longest.
  const auto three =
      polish_poses(slope, body, {pose}, {.evaluations = 3, .first_step = 0.5, .longest_step = 0.5});
  EXPECT_NEAR(three[0].score, 2.0, 1e-9);
}

TEST(Polish, RefusesBadOptions) {
  const PoseObjective flat = [](const RigidMotion&) { return PlacedScore{}; };
  const PolishBody body{Eigen::Vector3d::Zero(), 1.0};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((void)polish_poses(flat, {body.centre, 0.0}, {}), InputError);
  EXPECT_THROW((void)polish_poses(flat, {body.centre, nan}, {}), InputError);
  EXPECT_THROW((void)polish_poses(flat, body, {}, {.evaluations = 0}), InputError);
  EXPECT_THROW((void)polish_poses(flat, body, {}, {.first_step = 0.0}), InputError);
  EXPECT_THROW((void)polish_poses(flat, body, {}, {.longest_step = nan}), InputError);
  EXPECT_THROW((void)polish_poses(flat, body, {}, {.tolerance = -1.0}), InputError);
  EXPECT_TRUE(polish_poses(flat, body, {}).empty());
}

}  // namespace
}  // namespace mortise
