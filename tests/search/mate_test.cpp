// SPDX-License-Identifier: GPL-3.0-or-later
// Mating of small parts: energy and its derivatives, polish, the search as a whole, determinism.
#include "mortise/search/mate.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <memory>

#include "metrics/bodies.hpp"
#include "mortise/core/errors.hpp"
#include "mortise/metrics/placement.hpp"
#include "mortise/parts/mesh_solid.hpp"
#include "search/mate_contact.hpp"
#include "search/voxel_parts.hpp"

namespace mortise {
namespace {

using testing::mortise_block;
using testing::tenon_plate;
using testing_bodies::random_motion;

MateOptions small_options() {
  MateOptions options;
  options.rotations = 600;
  options.spacing = 0.05;
  options.skin = 0.06;
  options.detail = 0.03;
  options.samples = 1000;
  options.polished = 60;
  options.poses = 10;
  return options;
}

ContactPair contact_pair(double spacing) {
  const MatePart block = mortise_block();
  const MatePart plate = tenon_plate();
  const auto body = [&](const MatePart& part) {
    return ContactBody(sample_surface(part.mesh, 400), DistanceField(*part.solid, spacing, 1.0, 0),
                       part.solid->bounds().center());
  };
  return {body(block), body(plate)};
}

double largest_error(const MatePart& moving, const RigidMotion& truth, const RigidMotion& found) {
  TrueMate mate;
  mate.moving_in_fixed = truth;
  return Placement(moving.mesh, mate).error(found).largest;
}

TEST(DistanceField, GradientIsThatOfTheInterpolation) {
  const MatePart block = mortise_block();
  const DistanceField field(*block.solid, 0.5, 1.0, 0);
  Eigen::Vector3f ignored;
  for (int i = 0; i < 50; ++i) {
    // Points within a cell, where the interpolation is a polynomial.
    const Eigen::Vector3d cell = (Eigen::Array3d::Random() * 4.0 + 6.0).floor();
    const Eigen::Vector3d x = field.low() + 0.5 * (cell + Eigen::Vector3d(0.3, 0.6, 0.45));
    Eigen::Vector3f gradient;
    (void)field.at(x.cast<float>(), gradient);
    for (int d = 0; d < 3; ++d) {
      const Eigen::Vector3d step = 0.05 * Eigen::Vector3d::Unit(d);
      const float difference =
          field.at((x + step).cast<float>(), ignored) - field.at((x - step).cast<float>(), ignored);
      EXPECT_NEAR(gradient[d], difference / 0.1F, 2e-5);  // rounding of single precision
    }
  }
  EXPECT_EQ(field.at(Eigen::Vector3f(-50, 0, 0), ignored), DistanceField::kFar);
}

TEST(ContactEnergy, GradientMeetsCentralDifferences) {
  const ContactPair pair = contact_pair(0.25);
  std::mt19937 random(8);
  for (int i = 0; i < 6; ++i) {
    const RigidMotion pose = random_motion(random, 0.15, 0.3);
    const Eigen::Vector3d centre(1.0, 2.0, 3.0);
    const double length = 2.5;
    const ContactEnergy here = pair.energy(pose, 0.4, 1.5, 1.0, centre, length);
    for (int d = 0; d < 6; ++d) {
      const auto at = [&](double h) {
        Eigen::Matrix<double, 6, 1> twist = Eigen::Matrix<double, 6, 1>::Zero();
        twist[d] = h;
        const Eigen::Vector3d w = twist.tail<3>() / length;
        const Eigen::Quaterniond q =
            w.norm() > 0 ? Eigen::Quaterniond(Eigen::AngleAxisd(w.norm(), w.normalized()))
                         : Eigen::Quaterniond::Identity();
        return pair
            .energy(compose({q, centre - q * centre + twist.head<3>()}, pose), 0.4, 1.5, 1.0,
                    centre, length)
            .value;
      };
      const double h = 3e-4;
      const double difference = (at(h) - at(-h)) / (2.0 * h);
      // The interpolated distance has kinks at cell walls, which some of 800 samples pass by.
      EXPECT_NEAR(here.gradient[d], difference, 0.01 * here.gradient.norm()) << i << ' ' << d;
    }
    // The curvature is that of the weights frozen: symmetric and not negative.
    EXPECT_EQ(here.curvature, here.curvature.transpose());
    EXPECT_GE(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(here.curvature).eigenvalues()[0],
              -1e-9 * here.curvature.norm());
  }
}

TEST(ContactEnergy, DescentIsNeverWorseAndReachesTheSeat) {
  const ContactPair pair = contact_pair(0.25);
  std::mt19937 random(9);
  int seated = 0;
  for (int i = 0; i < 20; ++i) {
    const RigidMotion start = random_motion(random, 0.1, 0.3);
    RigidMotion pose = start;
    for (const double sigma : {0.3, 0.15, 0.08}) {
      const RigidMotion next = pair.descend(pose, sigma, 2.0, 1.0, 15);
      const Eigen::Vector3d c = Eigen::Vector3d::Zero();
      EXPECT_LE(pair.energy(next, sigma, 2.0, 1.0, c, 1.0).value,
                pair.energy(pose, sigma, 2.0, 1.0, c, 1.0).value);
      pose = next;
    }
    seated += largest_error(tenon_plate(), {}, pose) < 0.005 ? 1 : 0;
  }
  EXPECT_GE(seated, 17);  // some starts are caught askew: the search makes many
}

TEST(ContactFit, OfTheSeatIsItsContactArea) {
  const ContactPair pair = contact_pair(0.25);
  const ContactFit seated = pair.fit({}, 0.05, 1.0);
  EXPECT_NEAR(seated.contact, 66.0, 0.1 * 66.0);  // see contact_test.cpp; the edges blur
  EXPECT_NEAR(seated.one_sided, 36.0, 4.0);       // floor and underside; the walls cancel
  RigidMotion raised;
  raised.translation << 0, 0, 0.5;
  const ContactFit walls = pair.fit(raised, 0.05, 1.0);
  EXPECT_NEAR(walls.contact, 25.0, 2.5);  // along 2.5 of the walls
  EXPECT_LT(walls.one_sided, 2.5);        // some samples of half a unit of area each
  RigidMotion sunk;
  sunk.translation << 0, 0, -0.1;
  EXPECT_GT(pair.fit(sunk, 0.05, 1.0).penetration, 36.0);
}

TEST(Mating, FindsTheTenonInItsMortiseFromARandomStart) {
  std::mt19937 random(11);
  const RigidMotion start = random_motion(random, 2.5, 10.0);
  const MatePart moving = tenon_plate(start);
  Mating mating(mortise_block(), moving, small_options());
  ASSERT_TRUE(mating.search().run());
  const PoseList list = mating.rank();
  ASSERT_EQ(list.poses.size(), 10U);
  const Pose& best = list.poses.front();
  EXPECT_LT(largest_error(moving, inverse(start), best.moving_in_fixed), 0.002);
  EXPECT_EQ(best.score, best.channels[0] + best.channels[1]);
  EXPECT_EQ(mating.judge(best.moving_in_fixed).score, best.score);
  EXPECT_GE(mating.judge(mating.polish(best.moving_in_fixed)).score, best.score);
  for (std::size_t i = 1; i < list.poses.size(); ++i)
    EXPECT_LE(list.poses[i].score, list.poses[i - 1].score);
}

// By the skeletal densities nearly alone: the skin's share of the score is a hundredth.
TEST(Mating, FindsTheTenonBySkeletalDensityToo) {
  std::mt19937 random(13);
  const RigidMotion start = random_motion(random, 2.5, 10.0);
  MatePart fixed = mortise_block();
  MatePart moving = tenon_plate(start);
  fixed.solid = std::make_shared<MeshSolid>(fixed.mesh);
  moving.solid = std::make_shared<MeshSolid>(moving.mesh);
  MateOptions options = small_options();
  options.skeletal = 100.0;
  EXPECT_THROW(Mating(mortise_block(), moving, options), InputError);  // no MeshSolid
  Mating mating(fixed, moving, options);
  ASSERT_TRUE(mating.search().run());
  const PoseList list = mating.rank();
  EXPECT_LT(largest_error(moving, inverse(start), list.poses.front().moving_in_fixed), 0.002);
  options.skeletal = -1.0;
  EXPECT_THROW(Mating(fixed, moving, options), InputError);
}

TEST(Mating, DoesNotDependOnThreadsOrOnBeingStopped) {
  MateOptions options = small_options();
  options.rotations = 300;
  options.threads = 1;
  Mating one(mortise_block(), tenon_plate(), options);
  ASSERT_TRUE(one.search().run());
  const PoseList expected = one.rank();
  options.threads = 3;
  Mating first(mortise_block(), tenon_plate(), options);
  ASSERT_FALSE(first.search().run([](std::size_t, std::size_t) { return false; }));
  Mating second(mortise_block(), tenon_plate(), options);
  second.search().resume(first.search().done(), first.search().candidates());
  ASSERT_TRUE(second.search().run());
  const PoseList found = second.rank();
  ASSERT_EQ(found.poses.size(), expected.poses.size());
  for (std::size_t i = 0; i < found.poses.size(); ++i) {
    EXPECT_EQ(found.poses[i].score, expected.poses[i].score);
    EXPECT_EQ(found.poses[i].moving_in_fixed.translation,
              expected.poses[i].moving_in_fixed.translation);
    EXPECT_EQ(found.poses[i].moving_in_fixed.rotation.coeffs(),
              expected.poses[i].moving_in_fixed.rotation.coeffs());
  }
}

TEST(Mating, TurnsAboutAGivenAxisOnly) {
  std::mt19937 random(12);
  const RigidMotion start = random_motion(random, 2.5, 10.0);
  const MatePart moving = tenon_plate(start);
  MateOptions options = small_options();
  options.rotations = 36;
  options.axis = MateAxis{Eigen::Vector3d::UnitZ(), start.rotation * Eigen::Vector3d(0, 0, 2)};
  Mating mating(mortise_block(), moving, options);
  ASSERT_EQ(mating.rotations().size(), 72);
  ASSERT_TRUE(mating.search().run());
  // Before polish: the moving axis lies along the fixed one at every candidate.
  for (const Candidate& c : mating.search().candidates()) {
    const RigidMotion pose = mating.search().moving_in_fixed(c);
    EXPECT_NEAR(std::abs((pose.rotation * start.rotation * Eigen::Vector3d::UnitZ()).z()), 1.0,
                1e-6);
  }
  EXPECT_LT(largest_error(moving, inverse(start), mating.rank().poses.front().moving_in_fixed),
            0.002);
}

TEST(Mating, IsTheSameForPartsTenTimesAsLarge) {
  MateOptions options = small_options();
  options.rotations = 300;
  const auto scaled = [](const MatePart& part) {
    class Scaled : public Solid {
     public:
      explicit Scaled(std::shared_ptr<const Solid> solid) : solid_(std::move(solid)) {}
      [[nodiscard]] Eigen::AlignedBox3d bounds() const override {
        const Eigen::AlignedBox3d box = solid_->bounds();
        return {8.0 * box.min(), 8.0 * box.max()};
      }
      [[nodiscard]] Eigen::VectorXd signed_distance(const Eigen::Matrix3Xd& points,
                                                    double band) const override {
        return 8.0 * solid_->signed_distance(points / 8.0, band / 8.0);
      }

     private:
      std::shared_ptr<const Solid> solid_;
    };
    MatePart result{part.mesh, std::make_shared<Scaled>(part.solid)};
    result.mesh.vertices *= 8.0;  // a power of two: nothing rounds
    return result;
  };
  Mating small(mortise_block(), tenon_plate(), options);
  Mating large(scaled(mortise_block()), scaled(tenon_plate()), options);
  ASSERT_TRUE(small.search().run());
  ASSERT_TRUE(large.search().run());
  const PoseList a = small.rank();
  const PoseList b = large.rank();
  ASSERT_EQ(a.poses.size(), b.poses.size());
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(a.poses[i].score, b.poses[i].score, 1e-4);
    EXPECT_LT(
        (8.0 * a.poses[i].moving_in_fixed.translation - b.poses[i].moving_in_fixed.translation)
            .norm(),
        0.01);
  }
}

TEST(Mating, RefusesWhatItCannotWorkWith) {
  const auto expect_refused = [](void (*spoil)(MateOptions&), const char* message) {
    MateOptions options = small_options();
    spoil(options);
    try {
      Mating(mortise_block(), tenon_plate(), options);
      ADD_FAILURE() << message;
    } catch (const InputError& e) {
      EXPECT_THAT(e.what(), ::testing::HasSubstr(message));
    }
  };
  expect_refused([](MateOptions& o) { o.spacing = 0.0; }, "spacing");
  expect_refused([](MateOptions& o) { o.skin = std::nan(""); }, "skin");
  expect_refused([](MateOptions& o) { o.penalty = 1.0; }, "penalty");
  expect_refused([](MateOptions& o) { o.rotations = 0; }, "rotations");
  expect_refused(
      [](MateOptions& o) {
        o.axis = MateAxis{Eigen::Vector3d::Zero(), {1, 0, 0}};
      },
      "axis");
  EXPECT_THROW(Mating({{}, mortise_block().solid}, tenon_plate(), small_options()), InputError);
  EXPECT_THROW((void)mate_preset("slow"), InputError);
}

}  // namespace
}  // namespace mortise
