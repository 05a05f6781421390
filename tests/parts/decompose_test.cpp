// SPDX-License-Identifier: GPL-3.0-or-later
// Spherical decompositions: the propositions of the paper, by dense sampling of simple solids.
#include "mortise/parts/decompose.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "mortise/core/errors.hpp"
#include "mortise/parts/uncontained_balls.hpp"
#include "reference/analytic_solids.hpp"

namespace mortise {
namespace {

using Shape = std::shared_ptr<const Solid>;

Shape slanted_capsule() {
  return reference::make_capsule({-1.0, -0.4, 0.2}, {1.1, 0.7, 0.5}, 0.31);
}
Shape torus() { return reference::make_torus({0.3, -0.2, 0.1}, 1.0, 0.33); }
Shape box() { return reference::make_box({-0.5, -0.31, -0.77}, {0.4, 0.52, 0.6}); }
Shape dumbbell() {
  return reference::unite({reference::make_ball({-1, 0, 0}, 0.6),
                           reference::make_ball({1, 0.1, 0}, 0.45),
                           reference::make_capsule({-1, 0, 0}, {1, 0.1, 0}, 0.12)});
}

// Points of the box of the solid, n along the longest side, in general position.
Eigen::Matrix3Xd box_points(const Solid& solid, int n) {
  const Eigen::AlignedBox3d box = solid.bounds();
  const double step = box.sizes().maxCoeff() / n;
  const Eigen::Array3i size = (box.sizes() / step).array().ceil().cast<int>();
  Eigen::Matrix3Xd points(3, size.prod());
  Eigen::Index i = 0;
  for (int x = 0; x < size.x(); ++x)
    for (int y = 0; y < size.y(); ++y)
      for (int z = 0; z < size.z(); ++z)
        points.col(i++) = box.min() + step * Eigen::Vector3d(x + 0.317, y + 0.561, z + 0.439);
  return points;
}

// Distance to the union of balls, 0 inside, by looking at all of them.
double distance_to_union(const Eigen::Matrix4Xd& balls, const Eigen::Vector3d& p) {
  const Eigen::ArrayXd d = (balls.topRows<3>().colwise() - p).colwise().norm().transpose();
  return std::max(0.0, (d - balls.row(3).transpose().array()).minCoeff());
}

// The largest way from a sampled point of the solid to the union.
double solid_beyond(const Solid& solid, const Eigen::Matrix4Xd& balls, int samples) {
  const Eigen::Matrix3Xd points = box_points(solid, samples);
  const Eigen::VectorXd depth = solid.signed_distance(points, 1e9);
  double most = 0.0;
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    if (depth[i] <= 0.0) most = std::max(most, distance_to_union(balls, points.col(i)));
  return most;
}

// The largest way from a point of a ball's sphere to the solid.
double balls_beyond(const Solid& solid, const Eigen::Matrix4Xd& balls) {
  constexpr int kPoints = 300;
  Eigen::Matrix3Xd sphere(3, kPoints);
  for (int i = 0; i < kPoints; ++i) {
    const double z = 1.0 - (2.0 * i + 1.0) / kPoints, angle = i * std::numbers::pi * 2.399963;
    const double s = std::sqrt(1.0 - z * z);
    sphere.col(i) << s * std::cos(angle), s * std::sin(angle), z;
  }
  double most = 0.0;
  for (Eigen::Index k = 0; k < balls.cols(); ++k) {
    const Eigen::Matrix3Xd points =
        (balls(3, k) * sphere).colwise() + Eigen::Vector3d(balls.col(k).head<3>());
    most = std::max(most, solid.signed_distance(points, 1e9).maxCoeff());
  }
  return most;
}

struct SolidCase {
  std::string name;
  Shape solid;
};

std::vector<SolidCase> solid_cases() {
  return {{"capsule", slanted_capsule()},
          {"torus", torus()},
          {"box", box()},
          {"dumbbell", dumbbell()},
          {"ball", reference::make_ball({0.1, 0.2, 0.3}, 1.0)}};
}

constexpr std::array kMethods = {DecomposeMethod::kSkeletal, DecomposeMethod::kInnerPacking,
                                 DecomposeMethod::kOctree};
constexpr std::array kReductions = {Reduction::kCover, Reduction::kContainment, Reduction::kNone};

TEST(Decompose, Proposition1InnerBallsLieInTheSolidAndHoldEveryNode) {
  for (const SolidCase& c : solid_cases())
    for (const DecomposeMethod method : kMethods) {
      SCOPED_TRACE(c.name + " method " + std::to_string(static_cast<int>(method)));
      const Decomposition d = decompose(*c.solid, {.method = method, .grid = 20, .threads = 1});
      // Depths are kept in single precision.
      EXPECT_LE(balls_beyond(*c.solid, d.inner), 1e-5);
      EXPECT_LE(solid_beyond(*c.solid, d.inner, 37), d.epsilon);
    }
}

TEST(Decompose, Propositions2And3KnotsAreWithinEpsilonOfTheSolid) {
  for (const SolidCase& c : solid_cases())
    for (const DecomposeMethod method : kMethods)
      for (const Reduction reduction : kReductions) {
        SCOPED_TRACE(c.name + " method " + std::to_string(static_cast<int>(method)) +
                     " reduction " + std::to_string(static_cast<int>(reduction)));
        const Decomposition d = decompose(
            *c.solid, {.method = method, .reduction = reduction, .grid = 20, .threads = 1});
        EXPECT_LE(balls_beyond(*c.solid, d.knots.points), d.epsilon * (1 + 1e-5));
        EXPECT_LE(solid_beyond(*c.solid, d.knots.points, 37), d.epsilon);
        EXPECT_EQ(d.coverage, 1.0);
        EXPECT_LE(d.knots.size(), d.inner.cols());
      }
}

// The grid of decompose(), its depths and nodes, for the references below.
struct Nodes {
  std::vector<Eigen::Vector3d> position;
  std::vector<double> depth;
  std::vector<double> flux;  // of the depth's gradient into the cell, by the six neighbours
};

Nodes cube_nodes(const Solid& solid, int grid) {
  const Eigen::AlignedBox3d box = solid.bounds();
  const double h = box.sizes().maxCoeff() / grid;
  const Eigen::Array3i size = (box.sizes().array() / h - 1e-9).ceil().cast<int>();
  Eigen::Matrix3Xd points(3, (size + 2).prod());
  Eigen::Index n = 0;
  for (int x = -1; x <= size.x(); ++x)
    for (int y = -1; y <= size.y(); ++y)
      for (int z = -1; z <= size.z(); ++z)
        points.col(n++) = box.center() +
                          h * (Eigen::Vector3d(x, y, z) - 0.5 * (size - 1).cast<double>().matrix());
  // Single precision, as the library keeps them, so that the order is the same.
  const Eigen::VectorXf depth =
      (-solid.signed_distance(points, 1e9).cast<float>().cast<double>() / h).cast<float>();
  Nodes nodes;
  const auto at = [&](int x, int y, int z) {
    const bool outside = x < 0 || y < 0 || z < 0 || x >= size.x() || y >= size.y() || z >= size.z();
    return outside ? -1.0F : depth[((x + 1) * (size.y() + 2) + y + 1) * (size.z() + 2) + z + 1];
  };
  n = 0;
  for (int x = -1; x <= size.x(); ++x)
    for (int y = -1; y <= size.y(); ++y)
      for (int z = -1; z <= size.z(); ++z, ++n)
        if (at(x, y, z) > 0.0F) {
          nodes.position.emplace_back(points.col(n) / h);
          nodes.depth.push_back(at(x, y, z));
          nodes.flux.push_back(6.0F * at(x, y, z) - at(x - 1, y, z) - at(x + 1, y, z) -
                               at(x, y - 1, z) - at(x, y + 1, z) - at(x, y, z - 1) -
                               at(x, y, z + 1));
        }
  return nodes;
}

// Step 1 of [SD, Alg. 1] as it is written, looking at all nodes each time.
std::vector<std::size_t> algorithm_1(const Nodes& nodes, double mu) {
  const std::size_t count = nodes.depth.size();
  std::vector<char> covered(count, 0), popped(count, 0);
  std::vector<std::size_t> chosen;
  while (std::count(covered.begin(), covered.end(), 0) > 0) {
    std::size_t best = count;
    for (std::size_t i = 0; i < count; ++i)
      if (popped[i] == 0 && (best == count || std::pair(nodes.flux[i], nodes.depth[i]) >
                                                  std::pair(nodes.flux[best], nodes.depth[best])))
        best = i;
    if (best == count) break;
    chosen.push_back(best);
    for (std::size_t i = 0; i < count; ++i) {
      const double away = (nodes.position[i] - nodes.position[best]).norm();
      if (away <= nodes.depth[best]) covered[i] = 1;
      if (away - (nodes.depth[best] - nodes.depth[i]) <= mu * nodes.depth[i]) popped[i] = 1;
    }
  }
  return chosen;
}

TEST(Decompose, SkeletalBallsAreThoseOfTheAlgorithmWrittenOut) {
  for (const double mu : {0.1, 0.25, 0.5, 1.0})
    for (const Shape& solid : {slanted_capsule(), dumbbell()}) {
      const Nodes nodes = cube_nodes(*solid, 19);
      const std::vector<std::size_t> expected = algorithm_1(nodes, mu);
      const Decomposition d = decompose(*solid, {.grid = 19, .protrusion = mu, .threads = 1});
      ASSERT_EQ(d.inside, static_cast<Eigen::Index>(nodes.depth.size()));
      ASSERT_EQ(d.inner.cols(), static_cast<Eigen::Index>(expected.size())) << "mu " << mu;
      for (Eigen::Index i = 0; i < d.inner.cols(); ++i) {
        EXPECT_NEAR((d.inner.col(i).head<3>() / d.spacing - nodes.position[expected[i]]).norm(),
                    0.0, 1e-9);
        EXPECT_NEAR(d.inner(3, i) / d.spacing, nodes.depth[expected[i]], 1e-6);
      }
    }
}

TEST(Decompose, PackedBallsDoNotOverlapAndEachIsTheLargestThatFits) {
  const Decomposition d =
      decompose(*dumbbell(), {.method = DecomposeMethod::kInnerPacking, .grid = 24, .threads = 1});
  for (Eigen::Index i = 0; i < d.inner.cols(); ++i) {
    if (i > 0) {
      EXPECT_LE(d.inner(3, i), d.inner(3, i - 1));
    }
    for (Eigen::Index k = 0; k < i; ++k)
      EXPECT_GE((d.inner.col(i) - d.inner.col(k)).head<3>().norm(),
                (d.inner(3, i) + d.inner(3, k)) * (1.0 - 1e-6));
  }
  // Some room is taken from each ball after the first by those before it.
  const Nodes nodes = cube_nodes(*dumbbell(), 24);
  EXPECT_NEAR(d.inner(3, 0) / d.spacing, *std::max_element(nodes.depth.begin(), nodes.depth.end()),
              1e-6);
}

TEST(Decompose, ContainmentKeepsEveryInnerBallInAKnot) {
  const Decomposition d =
      decompose(*torus(), {.reduction = Reduction::kContainment, .grid = 24, .threads = 1});
  EXPECT_LT(d.knots.size(), d.inner.cols());
  for (Eigen::Index i = 0; i < d.inner.cols(); ++i) {
    const Eigen::ArrayXd room = d.knots.points.row(3).transpose().array() - d.inner(3, i) -
                                (d.knots.points.topRows<3>().colwise() - d.inner.col(i).head<3>())
                                    .colwise()
                                    .norm()
                                    .transpose()
                                    .array();
    EXPECT_GE(room.maxCoeff(), -1e-9 * d.spacing);
  }
}

TEST(Decompose, CoverNeedsFewestAndEachOfItsBalls) {
  for (const SolidCase& c : solid_cases()) {
    SCOPED_TRACE(c.name);
    DecomposeOptions options{.grid = 24, .threads = 1};
    const Decomposition cover = decompose(*c.solid, options);
    options.reduction = Reduction::kContainment;
    const Decomposition containment = decompose(*c.solid, options);
    options.method = DecomposeMethod::kOctree;
    EXPECT_LT(cover.knots.size(), containment.knots.size() + 1);
    EXPECT_LT(cover.knots.size(), decompose(*c.solid, options).knots.size());
  }
  // A ball is one ball.
  EXPECT_EQ(decompose(*reference::make_ball({1, 2, 3}, 0.7), {.grid = 31}).knots.size(), 1);
}

TEST(Decompose, PartsThinnerThanACellAreReachedToo) {
  // A plate of a third of a cell beside a block: few or none of its nodes are inside.
  for (const double shift : {0.0, 0.21, 0.5, 0.77}) {
    const double h = 2.0 / 20;
    const double z = 0.5 * h + shift * h;
    const Shape solid =
        reference::unite({reference::make_box({-1, -1, -0.5}, {-0.4, 1, 0.6}),
                          reference::make_box({-0.5, -1, z}, {1, 1, z + 0.33 * h})});
    const Decomposition d = decompose(*solid, {.grid = 20, .threads = 1});
    EXPECT_LE(balls_beyond(*solid, d.knots.points), d.epsilon * (1 + 1e-5)) << shift;
    EXPECT_LE(solid_beyond(*solid, d.knots.points, 90), d.epsilon) << shift;
  }
}

TEST(Decompose, WithoutExpansionKnotsLieInside) {
  const Decomposition d = decompose(*torus(), {.grid = 24, .expansion = 0.0, .threads = 1});
  EXPECT_LE(balls_beyond(*torus(), d.knots.points), 1e-5);
  EXPECT_LE(solid_beyond(*torus(), d.knots.points, 47), d.epsilon);
  EXPECT_EQ(d.coverage, 1.0);
}

TEST(Decompose, SharesAddUpToTheVolume) {
  DecomposeOptions options{.grid = 40, .expansion = 0.0, .threads = 1};
  options.weights = KnotWeights::kShare;
  const Decomposition d = decompose(*torus(), options);
  const Eigen::ArrayXd radius = d.knots.points.row(3).transpose();
  const double volume =
      (d.knots.weights.real().array() * radius.cube()).sum() * 4.0 / 3.0 * std::numbers::pi;
  const double torus_volume = 2.0 * std::numbers::pi * std::numbers::pi * 0.33 * 0.33;
  // The balls' nodes count for their volumes, and balls from inside fall short of the torus.
  EXPECT_NEAR(volume, torus_volume, 0.06 * torus_volume);
  EXPECT_NEAR(d.volume, torus_volume, 0.02 * torus_volume);
  EXPECT_TRUE((d.knots.weights.real().array() > 0.0).all());
  EXPECT_TRUE((d.knots.weights.real().array() <= 1.0).all());
}

TEST(Decompose, MovesAndScalesWithTheSolidAndThreadsDoNotMatter) {
  const Decomposition one = decompose(*box(), {.grid = 20, .threads = 1});
  const Decomposition two = decompose(*box(), {.grid = 20, .threads = 2});
  EXPECT_EQ(one.knots.points, two.knots.points);
  EXPECT_EQ(one.inner, two.inner);
  // By powers of two, so that nothing rounds.
  const Decomposition moved =
      decompose(*reference::make_box(Eigen::Vector3d(-0.5, -0.31, -0.77) * 4,
                                     Eigen::Vector3d(0.4, 0.52, 0.6) * 4),
                {.grid = 20});
  EXPECT_EQ(moved.knots.points, one.knots.points * 4);
  EXPECT_EQ(moved.epsilon, one.epsilon * 4);
}

TEST(Decompose, RefusesWhatItCannotDo) {
  const Shape solid = torus();
  EXPECT_THROW((void)decompose(*solid, {.grid = 1}), InputError);
  EXPECT_THROW((void)decompose(*solid, {.protrusion = 1.5}), InputError);
  EXPECT_THROW((void)decompose(*solid, {.protrusion = std::nan("")}), InputError);
  EXPECT_THROW((void)decompose(*solid, {.expansion = -0.1}), InputError);
  EXPECT_THROW((void)decompose(*reference::make_torus({0, 0, 0}, 1.0, 1e-3), {.grid = 4}),
               InputError);
  DistanceGrid grid;
  grid.size = {2, 2, 2};
  EXPECT_THROW((void)decompose(grid), InputError);
  grid.values.assign(8, -0.5F);
  grid.values[3] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW((void)decompose(grid), InputError);
}

}  // namespace
}  // namespace mortise
