// SPDX-License-Identifier: GPL-3.0-or-later
// Configuration products and quotients in SE(2) against brute force over samples and matrices.
#include "mortise/collision/configuration.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <set>

#include "mortise/core/errors.hpp"
#include "mortise/parts/mesh_solid.hpp"
#include "parts/shapes.hpp"

namespace mortise {
namespace {

constexpr int kTurns = 12;  // rotations about z are those of a clock

Eigen::Quaterniond turn(int k) {
  return canonical(Eigen::Quaterniond(
      Eigen::AngleAxisd(2.0 * std::numbers::pi * k / kTurns, Eigen::Vector3d::UnitZ())));
}

int turn_of(const Eigen::Quaterniond& q) {
  const double angle = 2.0 * std::atan2(q.z(), q.w());
  const long k = std::lround(angle * kTurns / (2.0 * std::numbers::pi));
  return static_cast<int>((k % kTurns + kTurns) % kTurns);
}

// Discs in the plane z = 0 at some of the rotations.
Configurations planar_set(const std::vector<int>& turns, int discs, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> place(-1.0F, 1.0F), radius(0.2F, 0.4F);
  Configurations set;
  for (const int k : turns) {
    Balls balls(4, discs);
    for (int i = 0; i < discs; ++i)
      balls.col(i) << place(random), place(random), 0.0F, radius(random);
    set.rotations.push_back(turn(k));
    set.translations.push_back(balls);
  }
  return set;
}

// How far inside a section a translation in the plane is; -infinity without that section.
double depth(const Configurations& set, int k, const Eigen::Vector2d& t) {
  double best = -std::numeric_limits<double>::infinity();
  for (std::size_t s = 0; s < set.rotations.size(); ++s) {
    if (turn_of(set.rotations[s]) != k) continue;
    for (const auto ball : set.translations[s].colwise())
      best =
          std::max(best, static_cast<double>(ball[3]) - (ball.head<2>().cast<double>() - t).norm());
  }
  return best;
}

// All motions of a set whose translations lie on a lattice, as 3 x 3 matrices: the uniform samples
// of Nelaturi and Shapiro.
std::vector<Eigen::Matrix3d> samples(const Configurations& set, double step) {
  std::vector<Eigen::Matrix3d> result;
  for (std::size_t s = 0; s < set.rotations.size(); ++s)
    for (double x = -2.0; x <= 2.0; x += step)
      for (double y = -2.0; y <= 2.0; y += step) {
        const bool inside = [&] {
          for (const auto ball : set.translations[s].colwise())
            if (std::hypot(ball[0] - x, ball[1] - y) <= ball[3]) return true;
          return false;
        }();
        if (!inside) continue;
        Eigen::Matrix3d motion = Eigen::Matrix3d::Identity();
        motion.topLeftCorner<2, 2>() = set.rotations[s].toRotationMatrix().topLeftCorner<2, 2>();
        motion(0, 2) = x;
        motion(1, 2) = y;
        result.push_back(motion);
      }
  return result;
}

TEST(ConfigurationProduct, IsThatOfSampledMatricesInThePlane) {
  const Configurations a = planar_set({0, 1, 5}, 2, 1), b = planar_set({0, 4, 11}, 2, 2);
  const Configurations product = configuration_product(a, b);
  // 0 4 11, 1 5 0, 5 9 4: six different ones.
  EXPECT_EQ(product.rotations.size(), 6U);
  const double step = 0.06;
  std::set<std::array<int, 3>> met;  // rotation and cells of the step's size
  for (const Eigen::Matrix3d& first : samples(a, step))
    for (const Eigen::Matrix3d& second : samples(b, step)) {
      const Eigen::Matrix3d both = first * second;
      const long k =
          std::lround(std::atan2(both(1, 0), both(0, 0)) * kTurns / (2.0 * std::numbers::pi));
      const int at = static_cast<int>((k + kTurns) % kTurns);
      const Eigen::Vector2d t = both.topRightCorner<2, 1>();
      ASSERT_GE(depth(product, at, t), -1e-5) << at << " " << t.transpose();
      met.insert({at, static_cast<int>(std::floor(t[0] / step)),
                  static_cast<int>(std::floor(t[1] / step))});
    }
  // The other way: a place deeper than two half diagonals of the lattices' cells is the product of
  // two samples to within as much.
  int checked = 0;
  for (int k = 0; k < kTurns; ++k)
    for (double x = -4.0; x < 4.0; x += 0.11)
      for (double y = -4.0; y < 4.0; y += 0.11) {
        if (!(depth(product, k, {x, y}) > 2.0 * step)) continue;
        ++checked;
        bool near = false;
        for (int i = -2; i <= 2; ++i)
          for (int j = -2; j <= 2; ++j)
            near = near || met.count({k, static_cast<int>(std::floor(x / step)) + i,
                                      static_cast<int>(std::floor(y / step)) + j}) != 0;
        EXPECT_TRUE(near) << k << " " << x << " " << y;
      }
  EXPECT_GT(checked, 1000);
}

TEST(ConfigurationProduct, InverseTurnsOrderAround) {
  const Configurations a = planar_set({2, 3}, 2, 3), b = planar_set({1, 7}, 3, 4);
  const Configurations one = inverse(configuration_product(a, b));
  const Configurations other = configuration_product(inverse(b), inverse(a));
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-3.0, 3.0);
  int inside = 0;
  for (int i = 0; i < 4000; ++i) {
    const int k = i % kTurns;
    const Eigen::Vector2d t(uniform(random), uniform(random));
    const double first = depth(one, k, t), second = depth(other, k, t);
    if (std::isinf(first)) {
      EXPECT_EQ(first, second);
      continue;
    }
    EXPECT_NEAR(first, second, 1e-5);
    inside += first > 0.0 ? 1 : 0;
  }
  EXPECT_GT(inside, 100);
}

TEST(ConfigurationProduct, GivesObstaclesAndSweeps) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Eigen::Matrix4Xd a(4, 7), b(4, 5);
  for (Eigen::Matrix4Xd* body : {&a, &b})
    for (auto ball : body->colwise())
      ball << uniform(random), uniform(random), uniform(random), 0.3 + 0.2 * uniform(random);
  const Eigen::Quaterniond rotation = Eigen::Quaterniond(0.3, -0.5, 0.7, 0.1).normalized();
  const Configurations obstacle = configuration_product(
      configurations_of_body(a, rotation), inverse(configurations_of_body(b)), {.offset = 0.1});
  ASSERT_EQ(obstacle.rotations.size(), 1U);
  EXPECT_LT(rotation_angle(obstacle.rotations[0], rotation), 1e-7);
  EXPECT_LT((obstacle.translations[0] - translational_obstacle(a, b, rotation, {.offset = 0.1}))
                .cwiseAbs()
                .maxCoeff(),
            2e-6);  // floats of numbers up to 4
  std::vector<RigidMotion> motions(9);
  for (std::size_t i = 0; i < motions.size(); ++i) {
    const double s = static_cast<double>(i);
    motions[i].rotation = Eigen::AngleAxisd(0.2 * s, Eigen::Vector3d(1, 2, 2) / 3.0);
    motions[i].translation = {0.1 * s, 0.0, -0.05 * s};
  }
  const Balls swept = all_translations(
      configuration_product(configurations_of_motions(motions, 0.25), configurations_of_body(b)));
  ASSERT_EQ(swept.cols(), 45);
  for (std::size_t m = 0; m < motions.size(); ++m)
    for (Eigen::Index i = 0; i < b.cols(); ++i) {
      const auto ball = swept.col(static_cast<Eigen::Index>(m) * b.cols() + i);
      const Eigen::Vector3d centre = motions[m] * Eigen::Vector3d(b.col(i).head<3>());
      EXPECT_LT((ball.head<3>().cast<double>() - centre).norm(), 1e-6);
      EXPECT_NEAR(ball[3], b(3, i) + 0.25, 1e-6);
    }
}

// A plate of 6 x 4 with a hole of radius 0.8 in its middle, without end along z.
class Plate : public Solid {
 public:
  [[nodiscard]] Eigen::AlignedBox3d bounds() const override {
    return {Eigen::Vector3d(-3, -2, -9), Eigen::Vector3d(3, 2, 9)};
  }
  [[nodiscard]] static double distance(double x, double y) {
    const Eigen::Array2d beyond(std::abs(x) - 3.0, std::abs(y) - 2.0);
    const double outer = beyond.max(0.0).matrix().norm() + std::min(beyond.maxCoeff(), 0.0);
    return std::max(outer, 0.8 - std::hypot(x, y));
  }
  [[nodiscard]] Eigen::VectorXd signed_distance(const Eigen::Matrix3Xd& points,
                                                double /*band*/) const override {
    Eigen::VectorXd result(points.cols());
    for (Eigen::Index i = 0; i < points.cols(); ++i)
      result[i] = distance(points(0, i), points(1, i));
    return result;
  }
};

TEST(ConfigurationQuotient, IsThatOfSampledPointsInThePlane) {
  Eigen::Matrix4Xd body(4, 3);  // an L of discs
  body << 0.0, 0.9, 1.5,        //
      0.0, 0.0, 0.6,            //
      0.0, 0.0, 0.0,            //
      0.5, 0.3, 0.2;
  std::vector<Eigen::Vector2d> points;  // of the discs' rims, which leave the plate first
  constexpr int kRim = 200;
  for (const auto disc : body.colwise())
    for (int i = 0; i < kRim; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / kRim;
      points.emplace_back(disc[0] + disc[3] * std::cos(angle), disc[1] + disc[3] * std::sin(angle));
    }
  std::mt19937 random(7);
  std::uniform_real_distribution<double> x(-3.5, 3.5), y(-2.5, 2.5);
  std::vector<RigidMotion> motions;
  for (int i = 0; i < 6000; ++i) motions.push_back({turn(i % kTurns), {x(random), y(random), 0.0}});
  const Eigen::VectorXd depth = containment_depth(Plate(), body, motions);
  int inside = 0, outside = 0;
  for (std::size_t m = 0; m < motions.size(); ++m) {
    const double found = depth[static_cast<Eigen::Index>(m)];
    // Rim points are pi r / kRim apart at most: 0.008 beside the one that sticks out the most,
    // which is so much nearer to the disc's own depth at least.
    if (std::abs(found) < 0.01) continue;
    const Eigen::Matrix2d R = motions[m].rotation.toRotationMatrix().topLeftCorner<2, 2>();
    const Eigen::Vector2d t = motions[m].translation.head<2>();
    const bool all = std::all_of(points.begin(), points.end(), [&](const Eigen::Vector2d& p) {
      const Eigen::Vector2d at = R * p + t;
      return Plate::distance(at[0], at[1]) <= 0.0;
    });
    // A disc around the whole hole has its rim in the plate; its centre tells.
    const bool around =
        std::any_of(body.colwise().begin(), body.colwise().end(), [&](const auto& disc) {
          const Eigen::Vector2d at = R * disc.template head<2>() + t;
          return Plate::distance(at[0], at[1]) > 0.0;
        });
    EXPECT_EQ(found > 0.0, all && !around) << motions[m].translation.transpose();
    (found > 0.0 ? inside : outside) += 1;
  }
  EXPECT_GT(inside, 200);
  EXPECT_GT(outside, 200);
}

TEST(ConfigurationQuotient, OfABoxByABallIsASmallerBox) {
  const MeshSolid box(shapes::box({4.0, 5.0, 6.0}));
  const Eigen::Vector4d ball(1.0, 0.0, 0.0, 0.5);
  const Eigen::Quaterniond quarter(
      Eigen::AngleAxisd(std::numbers::pi / 2, Eigen::Vector3d::UnitZ()));
  const double spacing = 0.1;
  const TriangleMesh places = quotient_mesh(box, ball, quarter, {.spacing = spacing});
  ASSERT_GT(places.size(), 100);
  const Eigen::Vector3d low = places.vertices.rowwise().minCoeff(),
                        high = places.vertices.rowwise().maxCoeff();
  const Eigen::Vector3d middle = box.bounds().center() - Eigen::Vector3d(0.0, 1.0, 0.0);
  // Flat faces are exact; edges lose what a cell's mean cuts off.
  EXPECT_LT((low - middle + Eigen::Vector3d(1.5, 2.0, 2.5)).norm(), 1e-5);
  EXPECT_LT((high - middle - Eigen::Vector3d(1.5, 2.0, 2.5)).norm(), 1e-5);
  EXPECT_NEAR(shapes::volume(places), 3.0 * 4.0 * 5.0, 60.0 * spacing * 0.05);
  const Eigen::Vector4d large(0.0, 0.0, 0.0, 2.1);
  EXPECT_EQ(quotient_mesh(box, large, quarter, {.spacing = spacing}).size(), 0);
}

TEST(ConfigurationProduct, RefusesBadInput) {
  const Configurations a = planar_set({0}, 1, 8);
  Configurations bad = a;
  bad.rotations[0] = Eigen::Quaterniond(2, 0, 0, 0);
  EXPECT_THROW((void)configuration_product(a, bad), InputError);
  EXPECT_THROW((void)inverse(bad), InputError);
  bad = a;
  bad.rotations.push_back(Eigen::Quaterniond::Identity());
  EXPECT_THROW((void)configuration_product(bad, a), InputError);
  bad = a;
  bad.translations[0](3, 0) = -1.0F;
  EXPECT_THROW((void)configuration_product(a, bad), InputError);
  EXPECT_THROW((void)containment_depth(Plate(), Eigen::Matrix4Xd(4, 0), {}), InputError);
  EXPECT_THROW((void)quotient_mesh(Plate(), Eigen::Vector4d(0, 0, 0, 1),
                                   Eigen::Quaterniond::Identity(), {.spacing = -1.0}),
               InputError);
}

}  // namespace
}  // namespace mortise
