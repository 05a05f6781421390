// SPDX-License-Identifier: GPL-3.0-or-later
// The 4D form and the compressed one on whole score grids: against each other and against the
// series summed knot by knot; a molecule's atoms, a part's balls.
#include <gtest/gtest.h>

#include <cmath>

#include "mortise/affinity/double_skin.hpp"
#include "mortise/molecules/read_molecule.hpp"
#include "mortise/molecules/to_knots.hpp"
#include "mortise/parts/decompose.hpp"
#include "mortise/search/rotation_search.hpp"
#include "reference/analytic_solids.hpp"
#include "reference/score_series.hpp"
#include "search/sample_bodies.hpp"

namespace mortise {
namespace {

using namespace sample_bodies;

struct Bodies {
  const char* name;
  Channel channel;
  double spacing;
};

std::vector<Bodies> sample_pairs() {
  const std::string file = std::string(MORTISE_SOURCE_DIR) + "/molecules/1hpv_ligand.pdb";
  const Knots atoms = to_knots(read_molecule(parse_molecule_spec(file)).molecule, {.radius = 0.0});
  // A peg and a frame: balls from a quarter of the grid's cell to the peg's radius.
  const auto plate = reference::unite({reference::make_box({-2, -2, -0.5}, {-0.8, 2, 0.5}),
                                       reference::make_box({0.8, -2, -0.5}, {2, 2, 0.5}),
                                       reference::make_box({-0.8, 0.8, -0.5}, {0.8, 2, 0.5}),
                                       reference::make_box({-0.8, -2, -0.5}, {0.8, -0.8, 0.5})});
  const auto peg = reference::make_capsule({0, 0, -1}, {0, 0, 1}, 0.8);
  const Knots holed = decompose(*plate, {.grid = 24, .weights = KnotWeights::kShare}).knots;
  const Knots round = decompose(*peg, {.grid = 16, .weights = KnotWeights::kShare}).knots;
  return {{"atoms", double_skin_channel(atoms, atoms), 3.0},
          {"balls", double_skin_channel(holed, round, {.offset = 0.12, .penalty = 3.0}), 0.16}};
}

double rms(const std::vector<float>& a) {
  double sum = 0.0;
  for (const float x : a) sum += static_cast<double>(x) * x;
  return std::sqrt(sum / static_cast<double>(a.size()));
}

std::vector<float> difference(std::vector<float> a, const std::vector<float>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] -= b[i];
  return a;
}

TEST(Lift, BothFormsGiveTheSameScores) {
  std::mt19937 random(5);
  for (const Bodies& pair : sample_pairs()) {
    const Eigen::Matrix4Xd rotations = random_rotations(random, 2);
    const double unit = pair.spacing;
    EXPECT_NE(pair.channel.moving.points.row(3).minCoeff(),
              pair.channel.moving.points.row(3).maxCoeff());
    // The window ends at half the grid's Nyquist frequency, so that spreading on the unenlarged
    // grid, which the 4D form has not, does not show.
    SearchOptions options{.spacing = unit,
                          .cutoff = 0.25 / unit,
                          .spread_width = 8,
                          .offsets = {0.0, 0.1 * unit, 0.3 * unit}};
    for (const double tolerance : {1e-2, 3e-3, 1e-4}) {
      options.radius_tolerance = tolerance;
      options.lift = SearchLift::kCompressed;
      RotationSearch compressed({pair.channel}, rotations, options);
      options.lift = SearchLift::k4d;
      RotationSearch lifted({pair.channel}, rotations, options);
      for (int o = 0; o < 3; ++o) {
        const std::vector<float> a = compressed.score_grid(1, o), b = lifted.score_grid(1, o);
        ASSERT_EQ(a.size(), b.size());
        EXPECT_LT(rms(difference(a, b)), 3.0 * tolerance * rms(b))
            << pair.name << ", offset " << o << ", tolerance " << tolerance;
      }
    }
    // 4D, at the finest tolerance, against the sum knot by knot.
    options.lift = SearchLift::k4d;
    RotationSearch lifted({pair.channel}, rotations, options);
    Channel grown = pair.channel;
    grown.moving.points.row(3).array() += options.offsets[2];
    const RigidMotion turn{quaternion(rotations.col(0)), Eigen::Vector3d::Zero()};
    const reference::ScoreSeries series({grown}, lifted.search_from_fixed(),
                                        compose(turn, lifted.search_from_moving()),
                                        lifted.grid_size(), lifted.spacing(), options.cutoff);
    const std::vector<float> grid = lifted.score_grid(0, 2);
    const auto [nx, ny, nz] = lifted.grid_size();
    double error = 0.0, norm = 0.0;
    for (int n = 0; n < 150; ++n) {
      const int i = static_cast<int>(random() % nx), j = static_cast<int>(random() % ny),
                k = static_cast<int>(random() % nz);
      const double expected = series(lifted.translation_of(i, j, k));
      error += std::pow(grid[(static_cast<std::size_t>(i) * ny + j) * nz + k] - expected, 2);
      norm += expected * expected;
    }
    EXPECT_LT(std::sqrt(error / norm), 3e-4) << pair.name;
  }
}

TEST(Lift, CandidatesAreTheSameOnesAtFineTolerance) {
  std::mt19937 random(6);
  const std::vector<double> radii = {1.42, 1.61, 1.77, 1.88};
  const Channel channel = double_skin_channel(ellipsoid(random, 90, {13, 8, 6}, {1, 2, 3}, radii),
                                              ellipsoid(random, 40, {6, 4, 5}, {0, 0, 0}, radii));
  const Eigen::Matrix4Xd rotations = random_rotations(random, 4);
  SearchOptions options{
      .spacing = 2.0, .cutoff = 0.125, .spread_width = 8, .radius_tolerance = 1e-4};
  RotationSearch compressed({channel}, rotations, options);
  options.lift = SearchLift::k4d;
  RotationSearch lifted({channel}, rotations, options);
  options.threads = 1;
  RotationSearch alone({channel}, rotations, options);
  for (RotationSearch* search : {&compressed, &lifted, &alone}) search->run();
  const auto a = compressed.candidates(), b = lifted.candidates(), c = alone.candidates();
  ASSERT_EQ(a.size(), b.size());
  ASSERT_EQ(a.size(), c.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].rotation_index, b[i].rotation_index);
    EXPECT_NEAR(a[i].score, b[i].score, 2e-3 * std::abs(b[i].score));
    EXPECT_EQ(b[i].score, c[i].score);  // threads change nothing
    EXPECT_EQ(b[i].translation, c[i].translation);
  }
}

}  // namespace
}  // namespace mortise
