// SPDX-License-Identifier: GPL-3.0-or-later
// Placement errors: by hand, against dense sampling, over every kind of symmetry; truth files.
#include "mortise/metrics/placement.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include "helpers/random_motions.hpp"
#include "helpers/scratch_directory.hpp"
#include "metrics/bodies.hpp"
#include "mortise/core/errors.hpp"

namespace mortise {
namespace {

using tests::random_turn;

TriangleMesh box(double x, double y, double z) {
  TriangleMesh mesh;
  mesh.vertices.resize(3, 8);
  for (int i = 0; i < 8; ++i)
    mesh.vertices.col(i) << (i & 1) * x, (i >> 1 & 1) * y, (i >> 2 & 1) * z;
  mesh.triangles.resize(3, 12);
  mesh.triangles << 0, 0, 4, 4, 0, 0, 2, 2, 0, 0, 1, 1,  //
      2, 3, 5, 7, 1, 5, 6, 7, 4, 6, 3, 7,                //
      3, 1, 7, 6, 5, 4, 7, 3, 6, 2, 7, 5;
  return mesh;
}

std::vector<Symmetry> each_kind() {
  std::vector<Symmetry> all(6);
  for (Symmetry& s : all) {
    s.point << 1.0, -2.0, 0.5;
    s.direction = Eigen::Vector3d(1, 2, -0.5).normalized();
    s.to = 2.0 * std::numbers::pi;
  }
  all[0].kind = SymmetryKind::kTurn;
  all[1].kind = SymmetryKind::kFold;
  all[1].order = 5;
  all[2].kind = SymmetryKind::kScrew;
  all[2].pitch = 0.7;
  all[2].from = -9.0;
  all[2].to = 12.0;
  all[3].kind = SymmetryKind::kSlide;
  all[3].from = -1.0;
  all[3].to = 3.0;
  all[4].kind = SymmetryKind::kBall;
  all[5].kind = SymmetryKind::kRoll;
  all[5].moving_point << 4.0, 0.0, 1.0;
  all[5].moving_direction = all[5].direction;
  all[5].ratio = 2.5;
  return all;
}

TEST(Placement, ShiftAndTurnByHand) {
  const TriangleMesh mesh = box(1.0, 2.0, 2.0);  // diameter 3
  const Placement placement(mesh, {});
  EXPECT_NEAR(placement.diameter(), 3.0, 1e-12);
  const PlacementError shifted = placement.error({Eigen::Quaterniond::Identity(), {0, 0, 0.3}});
  EXPECT_NEAR(shifted.largest, 0.1, 1e-12);
  EXPECT_NEAR(shifted.rms, 0.1, 1e-12);
  // Half a turn about the edge x = y = 0: a point moves by twice its distance from it, at most
  // 2 sqrt(5).
  const PlacementError turned = placement.error(
      {Eigen::Quaterniond(Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d::UnitZ())),
       {0, 0, 0}});
  EXPECT_NEAR(turned.largest, 2.0 * std::sqrt(5.0) / 3.0, 1e-12);
  double sum = 0.0;
  const int n = 400;  // the same mean by brute force over the faces
  double area = 0.0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double u = (i + 0.5) / n;
      const double v = (j + 0.5) / n;
      const auto add = [&](double x, double y, double a) {
        sum += a * 4.0 * (x * x + y * y);
        area += a;
      };
      add(u, 2 * v, 4.0);  // z faces, 1 x 2 each
      add(0, 2 * u, 4.0);  // x = 0
      add(1, 2 * u, 4.0);  // x = 1
      add(u, 0, 2.0);      // y = 0
      add(u, 2, 2.0);      // y = 2
    }
  EXPECT_NEAR(turned.rms, std::sqrt(sum / area) / 3.0, 1e-5);
}

TEST(Placement, MembersOfEveryFamilyAreTrue) {
  const TriangleMesh mesh = box(1.0, 1.3, 2.0);
  std::mt19937 random(5);
  for (const Symmetry& s : each_kind()) {
    TrueMate truth;
    truth.moving_in_fixed = random_turn(random, 2.0, 5.0);
    truth.symmetries = {s};
    const Placement placement(mesh, truth);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (int i = 0; i < 10; ++i) {
      double at[3] = {s.from + (s.to - s.from) * unit(random), 0, 0};
      if (s.kind == SymmetryKind::kFold) at[0] = i % 5;
      if (s.kind == SymmetryKind::kBall)
        for (double& a : at) a = 3.4 * unit(random) - 1.7;
      const RigidMotion pose = compose(member(s, at), truth.moving_in_fixed);
      const PlacementError error = placement.error(pose);
      EXPECT_LT(error.rms, 1e-6) << static_cast<int>(s.kind) << ' ' << i;
      EXPECT_LT(error.largest, 1e-5) << static_cast<int>(s.kind) << ' ' << i;
    }
  }
}

TEST(Placement, IsNoWorseThanDenseSampling) {
  const TriangleMesh mesh = box(1.0, 1.3, 2.0);
  std::mt19937 random(6);
  const std::vector<Symmetry> kinds = each_kind();
  TrueMate truth;
  truth.moving_in_fixed = random_turn(random, 2.0, 1.0);
  truth.symmetries = {kinds[1], kinds[0], kinds[3]};  // fold, turn, slide
  const Placement placement(mesh, truth);
  const TrueMate bare;
  for (int i = 0; i < 3; ++i) {
    const RigidMotion pose = compose(random_turn(random, 0.3, 0.3), truth.moving_in_fixed);
    const PlacementError error = placement.error(pose);
    double rms = 1e9;
    double largest = 1e9;
    for (int f = 0; f < 5; ++f)
      for (int a = 0; a < 180; ++a)
        for (int b = 0; b <= 80; ++b) {
          const double p[3] = {static_cast<double>(f), a * std::numbers::pi / 90,
                               -1.0 + 4.0 * b / 80};
          const RigidMotion there =
              compose(compose(member(kinds[1], &p[0]),
                              compose(member(kinds[0], &p[1]), member(kinds[3], &p[2]))),
                      truth.moving_in_fixed);
          const Eigen::Matrix3Xd step = there * mesh.vertices - pose * mesh.vertices;
          largest = std::min(largest, step.colwise().norm().maxCoeff());
          if (step.colwise().norm().maxCoeff() > 2.0) continue;
          TrueMate one;
          one.moving_in_fixed = there;
          if (f == 0 || largest < 0.6) rms = std::min(rms, Placement(mesh, one).error(pose).rms);
        }
    EXPECT_LE(error.rms, rms + 1e-9);
    EXPECT_GE(error.rms, 0.9 * rms);  // the sampling is within a tenth
    EXPECT_LE(error.largest, 1.02 * largest / placement.diameter());
    EXPECT_GE(error.largest, error.rms);
  }
}

// The fold that is best in the mean need not be the one that is best at the worst point.
TEST(Placement, LargestIsTheLeastOfAllFolds) {
  const TriangleMesh mesh = box(0.3, 1.3, 2.0);
  TrueMate truth;
  truth.symmetries = {each_kind()[1]};
  const Placement placement(mesh, truth);
  std::mt19937 random(16);
  int elsewhere = 0;
  for (int i = 0; i < 200; ++i) {
    const RigidMotion pose = random_turn(random, 3.0, 2.0);
    double least = std::numeric_limits<double>::infinity();
    for (double fold = 0.0; fold < 5.0; ++fold) {
      const Eigen::Matrix3Xd step =
          member(truth.symmetries[0], &fold) * mesh.vertices - pose * mesh.vertices;
      least = std::min(least, step.colwise().norm().maxCoeff());
    }
    EXPECT_NEAR(placement.error(pose).largest, least / placement.diameter(), 1e-12);
    const Eigen::Matrix3Xd of_mean = placement.nearest(pose) * mesh.vertices - pose * mesh.vertices;
    elsewhere += of_mean.colwise().norm().maxCoeff() > 1.0001 * least ? 1 : 0;
  }
  EXPECT_GT(elsewhere, 0);  // else this tests nothing
}

TEST(Placement, IsTheSameInAnyUnit) {
  const std::vector<Symmetry> kinds = each_kind();
  std::mt19937 random(17);
  const RigidMotion where = random_turn(random, 2.0, 1.0);
  const RigidMotion pose = compose(random_turn(random, 0.3, 0.3), where);
  const auto error = [&](double scale) {
    TriangleMesh mesh = box(1.0, 1.3, 2.0);
    mesh.vertices *= scale;
    TrueMate truth;
    truth.moving_in_fixed = {where.rotation, scale * where.translation};
    Symmetry turn = kinds[0], slide = kinds[3];
    turn.point *= scale;
    slide.from *= scale;
    slide.to *= scale;
    truth.symmetries = {turn, slide};
    return Placement(mesh, truth).error({pose.rotation, scale * pose.translation});
  };
  const PlacementError one = error(1.0);
  for (const double scale : {1e-6, 1e-3, 1e3, 1e6}) {
    EXPECT_NEAR(error(scale).largest, one.largest, 1e-6) << scale;
    EXPECT_NEAR(error(scale).rms, one.rms, 1e-8) << scale;
  }
}

TEST(Placement, SlidesEndWhereTheyEnd) {
  TrueMate truth;
  truth.symmetries = {each_kind()[3]};
  const Eigen::Vector3d along = truth.symmetries[0].direction;
  const Placement placement(box(1.0, 2.0, 2.0), truth);
  EXPECT_NEAR(placement.error({Eigen::Quaterniond::Identity(), 3.6 * along}).largest, 0.2, 1e-9);
  EXPECT_NEAR(placement.error({Eigen::Quaterniond::Identity(), -1.3 * along}).rms, 0.1, 1e-9);
}

TEST(TrueMates, ReadsAFileAndNamesWhatIsWrong) {
  const tests::ScratchDirectory scratch;
  const std::string path = scratch / "mates.json";
  const auto write = [&](const std::string& text) { std::ofstream(path) << text; };
  write(R"({"pairs": [{"name": "peg", "fixed": "hole", "moving": "pin", "clearance": 0.005,
    "pose": {"rotation": [0, 1, 0, 0], "translation": [1, 2, 3]},
    "symmetries": [{"kind": "turn", "point": [0, 0, 0], "direction": [0, 0, 2]},
                   {"kind": "slide", "direction": [0, 0, 1], "from": -1, "to": 2}]}]})");
  const std::vector<TrueMate> mates = read_true_mates(path);
  ASSERT_EQ(mates.size(), 1U);
  EXPECT_EQ(mates[0].clearance, 0.005);
  EXPECT_EQ(mates[0].moving_in_fixed.translation, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(mates[0].symmetries[0].direction, Eigen::Vector3d(0, 0, 1));
  EXPECT_NEAR(mates[0].symmetries[0].to, 2 * std::numbers::pi, 1e-15);
  EXPECT_EQ(find_true_mate(mates, "hole", "pin").name, "peg");
  EXPECT_EQ(find_true_mate(mates, "", "", "peg").fixed, "hole");
  EXPECT_THROW((void)find_true_mate(mates, "pin", "hole"), InputError);
  const auto expect_refused = [&](const std::string& text, const std::string& message) {
    write(text);
    try {
      (void)read_true_mates(path);
      ADD_FAILURE() << text;
    } catch (const FileError& e) {
      EXPECT_THAT(e.what(), ::testing::HasSubstr(message));
    }
  };
  expect_refused("{", path);
  expect_refused(R"({"pairs": [{"fixed": "a"}]})", "pair 1: ");
  expect_refused(R"({"pairs": [{"fixed": "a", "moving": "b",
    "pose": {"rotation": [1, 1, 0, 0], "translation": [0, 0, 0]}}]})",
                 "unit quaternion");
  expect_refused(R"({"pairs": [{"fixed": "a", "moving": "b",
    "pose": {"rotation": [1, 0, 0, 0], "translation": [0, 0, 0]},
    "symmetries": [{"kind": "twist"}]}]})",
                 "twist");
  EXPECT_THROW((void)read_true_mates(path), FileError);
}

TEST(TrueMates, SaysThatAPairIsThereTheOtherWayRound) {
  std::vector<TrueMate> mates(2);
  mates[0].name = "peg in hole";
  mates[0].fixed = "hole";
  mates[0].moving = "peg";
  mates[1].name = mates[1].fixed = "other";
  EXPECT_EQ(find_true_mate(mates, "hole", "peg").name, "peg in hole");
  try {
    (void)find_true_mate(mates, "peg", "hole");
    ADD_FAILURE();
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), ::testing::HasSubstr("the other way round (peg in hole)"));
  }
}

}  // namespace
}  // namespace mortise
