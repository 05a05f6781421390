// SPDX-License-Identifier: GPL-3.0-or-later
// The docking pipeline on made-up molecules: ranking, channels, clusters, options.
#include "mortise/runs/dock.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

#include "mortise/core/errors.hpp"
#include "mortise/core/pose_distance.hpp"
#include "mortise/molecules/contact_types.hpp"
#include "mortise/molecules/radii.hpp"
#include "mortise/scoring/contact_potential.hpp"
#include "mortise/scoring/score_maps.hpp"
#include "mortise/scoring/shape_scores.hpp"

namespace mortise {
namespace {

// A ball of leucine and lysine atoms at protein density.
Molecule blob(int count, std::uint32_t seed) {
  std::mt19937 generator(seed);
  const double radius = std::cbrt(count / 0.06 * 0.75 / 3.14159);
  std::uniform_real_distribution<double> side(-radius, radius);
  Molecule molecule;
  molecule.path = "blob";
  while (static_cast<int>(molecule.atoms.size()) < count) {
    const Eigen::Vector3d p(side(generator), side(generator), 1.3 * side(generator));
    if (Eigen::Vector3d(p[0], p[1], p[2] / 1.3).norm() > radius) continue;
    Atom atom;
    const bool lysine = generator() % 3 == 0;
    atom.name = lysine ? "NZ" : "CD1";
    atom.residue_name = lysine ? "LYS" : "LEU";
    atom.element = lysine ? "N" : "C";
    atom.chain = "A";
    atom.residue_number = static_cast<int>(molecule.atoms.size());
    atom.position = p + Eigen::Vector3d(30.0, -5.0, 12.0);
    molecule.atoms.push_back(atom);
  }
  return molecule;
}

DockOptions quick() {
  DockOptions options;
  options.rotations = 40;
  options.poses = 60;
  options.threads = 1;
  return options;
}

// A plan searched to its end and ranked.
struct Ranked {
  Ranked(const Body& fixed, const Body& moving, const DockOptions& options) {
    const SearchPlan plan = plan_dock(fixed, moving, options);
    RotationSearch search = make_search(plan);
    EXPECT_TRUE(search.run());
    candidates = search.candidates();
    list = rank_search(plan, search);
  }
  std::vector<Candidate> candidates;
  PoseList list;
};

TEST(Docking, RanksByTheSumOfItsChannelsAndKeepsClustersApart) {
  const Molecule fixed = blob(300, 1), moving = blob(150, 2);
  DockOptions options = quick();
  options.polish = false;  // which leaves the channels as they were found
  const Ranked docking(fixed, moving, options);
  const PoseList& list = docking.list;
  EXPECT_EQ(list.channel_names, (std::vector<std::string>{"shape", "contact"}));
  ASSERT_GT(list.poses.size(), 20U);
  EXPECT_LE(list.poses.size(), 60U);
  const PoseDistance distance(atom_positions(moving));
  const ContactPotential& potential = fitted_contact_potential();
  const TypedPoints a{atom_positions(fixed), contact_types(fixed)};
  const TypedPoints b{atom_positions(moving), contact_types(moving)};
  double error = 0.0, size = 0.0;
  for (std::size_t i = 0; i < list.poses.size(); ++i) {
    const Pose& pose = list.poses[i];
    EXPECT_DOUBLE_EQ(pose.score, pose.channels[0] + pose.channels[1]);
    if (i > 0) {
      EXPECT_LE(pose.score, list.poses[i - 1].score);
    }
    EXPECT_EQ(pose.cluster, static_cast<int>(i));
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_GE(distance.rmsd(pose.moving_in_fixed, list.poses[j].moving_in_fixed), 3.0 - 1e-9);
    const double exact = contact_score(a, b, pose.moving_in_fixed, potential);
    error += std::pow(pose.channels[1] - exact, 2);
    size += exact * exact;
  }
  EXPECT_LT(std::sqrt(error / size), 0.1);  // the maps are in the right frame: else about 1
}

TEST(Docking, WithoutRescoringTheScoreIsTheSearchs) {
  DockOptions options = quick();
  options.rescore = false;
  options.polish = false;
  options.cluster_radius = 0.0;
  const Ranked docking(blob(200, 3), blob(100, 4), options);
  const PoseList& list = docking.list;
  EXPECT_EQ(list.channel_names, std::vector<std::string>{"shape"});
  float best = -INFINITY;
  for (const Candidate& c : docking.candidates) best = std::max(best, c.score);
  EXPECT_EQ(list.poses.at(0).score, best);
  EXPECT_EQ(list.poses.size(), 60U);
}

TEST(Docking, TakesRadiiByTypeAndMergedAtoms) {
  const Molecule fixed = blob(700, 3), moving = blob(500, 4);
  DockOptions options = quick();
  options.polish = false;
  const SearchPlan uniform = plan_dock(fixed, moving, options);
  options.radius = 0.0;
  options.double_skin.penalty_radius = 1.8;
  const SearchPlan own = plan_dock(fixed, moving, options);
  options.merge_buried = 4.5;
  const SearchPlan merged = plan_dock(fixed, moving, options);
  EXPECT_EQ(own.fixed.knots.size(), uniform.fixed.knots.size());
  EXPECT_EQ(own.moving.knots.points(3, 0), atom_radius(moving.atoms[0]));
  EXPECT_NE(own.moving.knots.points(3, 0), uniform.moving.knots.points(3, 0));
  EXPECT_LT(merged.fixed.knots.size(), own.fixed.knots.size());
  EXPECT_LT(merged.moving.knots.size(), own.moving.knots.size());
  EXPECT_GT(merged.moving.knots.points.row(3).maxCoeff(), 3.0);
  EXPECT_FALSE(Ranked(fixed, moving, options).list.poses.empty());
}

// With atoms' own radii, and with merged ones, polish climbs the score that the search has: the
// low-passed one of all radii, here from maps of another kind.
TEST(Docking, PolishClimbsTheScoreOfBallsOfEverySize) {
  const Molecule fixed = blob(700, 3), moving = blob(500, 4);
  for (const double merge : {0.0, 4.5}) {
    DockOptions options = quick();
    options.rescore = false;
    options.radius = 0.0;
    options.double_skin.penalty_radius = 1.8;
    options.merge_buried = merge;
    options.cluster_radius = 0.0;
    const SearchPlan plan = plan_dock(fixed, moving, options);
    RotationSearch search = make_search(plan);
    ASSERT_TRUE(search.run());
    std::vector<RigidMotion> starts;
    for (const Candidate& c : search.candidates()) starts.push_back(search.moving_in_fixed(c));
    starts.resize(60);
    const std::vector<RigidMotion> ends = plan.stages.back().move(starts, 1);
    const LowPassedScoresOptions low_passed{.low_pass = {.cutoff = options.search.cutoff}};
    const Eigen::MatrixXd before = low_passed_scores(plan.channels[0], starts, low_passed);
    const Eigen::MatrixXd after = low_passed_scores(plan.channels[0], ends, low_passed);
    const double scale = before.cwiseAbs().mean();
    EXPECT_GT((after - before).mean(), 0.1 * scale) << merge;
    // Maps at 1 A linear between nodes and these differ by some percent: hardly any may fall.
    EXPECT_GT((after - before).minCoeff(), -0.1 * scale) << merge;
  }
}

TEST(Docking, PolishMovesPosesUphillAndKeepsTheirScores) {
  const Molecule fixed = blob(300, 1), moving = blob(150, 2);
  const PoseDistance distance(atom_positions(moving));
  for (const bool rescore : {true, false}) {
    DockOptions options = quick();
    options.rescore = rescore;
    options.poses = 200;  // more than there are
    const PoseList after = Ranked(fixed, moving, options).list;
    options.polish = false;
    const PoseList before = Ranked(fixed, moving, options).list;
    EXPECT_EQ(after.channel_names, before.channel_names);
    // Whether any fall together depends on the last bits; that they are merged is shown in
    // polish_test.
    EXPECT_LE(after.poses.size(), before.poses.size());
    EXPECT_GT(after.poses.size(), before.poses.size() / 2);
    // Maps that hold the shape too are laid out elsewhere: their 8 bits fall otherwise.
    EXPECT_NEAR(after.poses[0].score, before.poses[0].score, 1e-3 * before.poses[0].score);
    const double moved =
        distance.rmsd(after.poses[0].moving_in_fixed, before.poses[0].moving_in_fixed);
    EXPECT_GT(moved, 0.01);
    EXPECT_LT(moved, 8.0);  // evaluations times the longest step
    for (std::size_t i = 0; i < after.poses.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        EXPECT_GE(distance.rmsd(after.poses[i].moving_in_fixed, after.poses[j].moving_in_fixed),
                  3.0 - 1e-9);
  }
}

TEST(Docking, TakesALigandOfOneAtom) {
  EXPECT_FALSE(Ranked(blob(300, 1), blob(1, 2), quick()).list.poses.empty());
}

TEST(DockOptions, PresetsAndTheirErrors) {
  EXPECT_EQ(dock_preset("thorough").rotations, 54000);
  EXPECT_GT(dock_preset("fast").search.spacing, dock_preset("default").search.spacing);
  EXPECT_THROW((void)dock_preset("slow"), InputError);
  const Molecule body = blob(20, 5);
  const auto refused = [&](auto change) {
    DockOptions options = quick();
    change(options);
    EXPECT_THROW((void)plan_dock(body, body, options), InputError);
  };
  refused([](DockOptions& o) { o.rotations = 0; });
  refused([](DockOptions& o) { o.radius = -1.0; });
  refused([](DockOptions& o) { o.merge_buried = -4.0; });
  refused([](DockOptions& o) { o.poses = 0; });
  refused([](DockOptions& o) { o.cluster_radius = -1.0; });
  refused([](DockOptions& o) { o.potential = "no/such/file"; });
  EXPECT_THROW((void)plan_dock(Molecule{}, body, quick()), InputError);
}

}  // namespace
}  // namespace mortise
