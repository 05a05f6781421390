// SPDX-License-Identifier: GPL-3.0-or-later
// Mating of small parts: energy and its derivatives, polish, the search as a whole, determinism.
#include "mortise/runs/mate.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <memory>

#include "helpers/random_motions.hpp"
#include "metrics/bodies.hpp"
#include "mortise/core/errors.hpp"
#include "mortise/core/rotation_vector.hpp"
#include "mortise/metrics/placement.hpp"
#include "mortise/parts/decompose.hpp"
#include "mortise/parts/diameter.hpp"
#include "mortise/parts/mesh_solid.hpp"
#include "runs/voxel_parts.hpp"
#include "scoring/contact_pair.hpp"

namespace mortise {
namespace {

using testing_parts::mortise_block;
using testing_parts::tenon_plate;

MateOptions small_options() {
  MateOptions options;
  options.rotations = 600;
  options.spacing = 0.05;
  options.skin = 0.06;
  options.distance_spacing = 0.03;
  options.samples = 1000;
  options.polished = 60;
  options.poses = 10;
  return options;
}

ContactPair contact_pair(double spacing) {
  const Part block = mortise_block();
  const Part plate = tenon_plate();
  const auto body = [&](const Part& part) {
    return ContactBody(sample_surface(part.mesh, 400), DistanceField(*part.solid, spacing, 1.0, 0),
                       part.solid->bounds().center());
  };
  return {body(block), body(plate)};
}

double largest_error(const Part& moving, const RigidMotion& truth, const RigidMotion& found) {
  TrueMate mate;
  mate.moving_in_fixed = truth;
  return Placement(moving.mesh, mate).error(found).largest;
}

// The plan searched to its end and ranked.
PoseList ranked(const SearchPlan& plan) {
  RotationSearch search = make_search(plan);
  EXPECT_TRUE(search.run());
  return rank_search(plan, search);
}

TEST(DistanceField, GradientIsThatOfTheInterpolation) {
  const Part block = mortise_block();
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
    const RigidMotion pose = tests::random_turn(random, 0.15, 0.3);
    const Eigen::Vector3d centre(1.0, 2.0, 3.0);
    const double length = 2.5;
    const ContactEnergy here = pair.energy(pose, 0.4, 1.5, 1.0, centre, length);
    for (int d = 0; d < 6; ++d) {
      const auto at = [&](double h) {
        Eigen::Matrix<double, 6, 1> twist = Eigen::Matrix<double, 6, 1>::Zero();
        twist[d] = h;
        const Eigen::Quaterniond q = rotation_from_vector(twist.tail<3>() / length);
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
    const RigidMotion start = tests::random_turn(random, 0.1, 0.3);
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
  EXPECT_LT(walls.one_sided, 2.5);        // opposite walls cancel but for their samples
  RigidMotion sunk;
  sunk.translation << 0, 0, -0.1;
  EXPECT_GT(pair.fit(sunk, 0.05, 1.0).penetration, 36.0);
}

TEST(Mating, FindsTheTenonInItsMortiseFromARandomStart) {
  std::mt19937 random(11);
  const RigidMotion start = tests::random_turn(random, 2.5, 10.0);
  const Part moving = tenon_plate(start);
  const SearchPlan plan = plan_mate(mortise_block(), moving, small_options());
  const PoseList list = ranked(plan);
  ASSERT_EQ(list.poses.size(), 10U);
  const Pose& best = list.poses.front();
  EXPECT_LT(largest_error(moving, inverse(start), best.moving_in_fixed), 0.002);
  EXPECT_EQ(best.score, best.channels[0] + best.channels[1]);
  // The last stage judges a pose as it stands in the list, and moves it to no worse a place.
  const Stage& last = plan.stages.back();
  const auto judged = [&](const std::vector<RigidMotion>& poses) {
    return last.scorer->score(poses, 1).col(0).sum();
  };
  EXPECT_NEAR(judged({best.moving_in_fixed}), best.score, 1e-6);
  EXPECT_GE(judged(last.move({best.moving_in_fixed}, 1)), best.score - 1e-6);
  for (std::size_t i = 1; i < list.poses.size(); ++i)
    EXPECT_LE(list.poses[i].score, list.poses[i - 1].score);
}

// By the skeletal densities nearly alone: the skin's share of the score is a hundredth.
TEST(Mating, FindsTheTenonBySkeletalDensityToo) {
  std::mt19937 random(13);
  const RigidMotion start = tests::random_turn(random, 2.5, 10.0);
  Part fixed = mortise_block();
  Part moving = tenon_plate(start);
  fixed.solid = std::make_shared<MeshSolid>(fixed.mesh);
  moving.solid = std::make_shared<MeshSolid>(moving.mesh);
  MateOptions options = small_options();
  options.skeletal = 100.0;
  EXPECT_THROW((void)plan_mate(mortise_block(), moving, options), InputError);  // no MeshSolid
  const PoseList list = ranked(plan_mate(fixed, moving, options));
  EXPECT_LT(largest_error(moving, inverse(start), list.poses.front().moving_in_fixed), 0.002);
  options.skeletal = -1.0;
  EXPECT_THROW((void)plan_mate(fixed, moving, options), InputError);
}

TEST(Mating, TakesBallsAsTheyAre) {
  MateOptions options = small_options();
  options.knots = PartKnots::kBalls;
  const Part block = mortise_block(), plate = tenon_plate();
  const Knots a = decompose(*block.solid, {.grid = 16, .weights = KnotWeights::kShare}).knots;
  const Knots b = decompose(*plate.solid, {.grid = 16, .weights = KnotWeights::kShare}).knots;
  const SearchPlan plan = plan_mate(a, b, options);
  EXPECT_EQ(plan.fixed.knots.points, a.points);
  EXPECT_EQ(plan.moving.knots.points, b.points);
  EXPECT_EQ(plan.channels.front().fixed.weights.imag(), a.weights.real());
  options.skeletal = 1.0;  // is of nodes
  EXPECT_THROW((void)plan_mate(a, b, options), InputError);
}

TEST(Mating, DoesNotDependOnThreadsOrOnBeingStopped) {
  MateOptions options = small_options();
  options.rotations = 300;
  options.threads = 1;
  const PoseList expected = ranked(plan_mate(mortise_block(), tenon_plate(), options));
  options.threads = 3;
  const SearchPlan plan = plan_mate(mortise_block(), tenon_plate(), options);
  RotationSearch first = make_search(plan);
  ASSERT_FALSE(first.run([](std::size_t, std::size_t) { return false; }));
  RotationSearch second = make_search(plan);
  second.resume(first.done(), first.candidates());
  ASSERT_TRUE(second.run());
  const PoseList found = rank_search(plan, second);
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
  const RigidMotion start = tests::random_turn(random, 2.5, 10.0);
  const Part moving = tenon_plate(start);
  MateOptions options = small_options();
  options.rotations = 36;
  options.axis = MateAxis{Eigen::Vector3d::UnitZ(), start.rotation * Eigen::Vector3d(0, 0, 2)};
  const SearchPlan plan = plan_mate(mortise_block(), moving, options);
  ASSERT_EQ(plan.rotations.size(), 72);
  RotationSearch search = make_search(plan);
  ASSERT_TRUE(search.run());
  // Before polish: the moving axis lies along the fixed one at every candidate.
  for (const Candidate& c : search.candidates()) {
    const RigidMotion pose = search.moving_in_fixed(c);
    EXPECT_NEAR(std::abs((pose.rotation * start.rotation * Eigen::Vector3d::UnitZ()).z()), 1.0,
                1e-6);
  }
  EXPECT_LT(largest_error(moving, inverse(start),
                          rank_search(plan, search).poses.front().moving_in_fixed),
            0.002);
}

// x' = scale x + shift of a part.
Part moved_part(const Part& part, double scale, const Eigen::Vector3d& shift) {
  class Moved : public Solid {
   public:
    Moved(std::shared_ptr<const Solid> solid, double scale, Eigen::Vector3d shift)
        : solid_(std::move(solid)), scale_(scale), shift_(std::move(shift)) {}
    [[nodiscard]] Eigen::AlignedBox3d bounds() const override {
      const Eigen::AlignedBox3d box = solid_->bounds();
      return {Eigen::Vector3d(scale_ * box.min() + shift_),
              Eigen::Vector3d(scale_ * box.max() + shift_)};
    }
    [[nodiscard]] Eigen::VectorXd signed_distance(const Eigen::Matrix3Xd& points,
                                                  double band) const override {
      return scale_ * solid_->signed_distance((points.colwise() - shift_) / scale_, band / scale_);
    }

   private:
    std::shared_ptr<const Solid> solid_;
    double scale_;
    Eigen::Vector3d shift_;
  };
  Part result{part.mesh, std::make_shared<Moved>(part.solid, scale, shift)};
  result.mesh.vertices = (scale * part.mesh.vertices).colwise() + shift;
  return result;
}

TEST(Mating, IsTheSameForPartsOfAnyScaleAndPlace) {
  MateOptions options = small_options();
  options.rotations = 60;
  const SearchPlan plain = plan_mate(mortise_block(), tenon_plate(), options);
  const PoseList a = ranked(plain);
  const double diameter = std::min(diameter_of(mortise_block().mesh.vertices),
                                   diameter_of(tenon_plate().mesh.vertices));
  struct Case {
    double scale, diameters;
  };
  for (const Case& c : {Case{10.0, 0.0}, Case{1e-3, 0.0}, Case{1e12, 0.0}, Case{1.0, 1e5}}) {
    SCOPED_TRACE(::testing::Message() << c.scale << " and " << c.diameters);
    const Eigen::Vector3d shift =
        c.diameters * c.scale * diameter * Eigen::Vector3d(1.0, -0.7, 0.6);
    const Eigen::Vector3d other = -0.9 * shift;
    const SearchPlan moved = plan_mate(moved_part(mortise_block(), c.scale, shift),
                                       moved_part(tenon_plate(), c.scale, other), options);
    EXPECT_EQ(moved.rotations.size(), plain.rotations.size());
    const PoseList b = ranked(moved);
    ASSERT_EQ(a.poses.size(), b.poses.size());
    // Where coordinates round, at 1e5 diameters to 1e-11, samples fall elsewhere on the surface and
    // polish stops elsewhere in a flat minimum: 0.5% of the score were seen.
    EXPECT_NEAR(a.poses.front().score, b.poses.front().score, 0.02 * a.poses.front().score);
    const RigidMotion& m = b.poses.front().moving_in_fixed;
    const Eigen::Vector3d back = (m.translation - shift + m.rotation * other) / c.scale;
    const RigidMotion found{m.rotation, back};
    EXPECT_LT(largest_error(tenon_plate(), a.poses.front().moving_in_fixed, found), 1e-3);
  }
}

TEST(Mating, SaysWhichPartIsTooSmallForTheGrid) {
  MateOptions options = small_options();
  options.rotations = 1;
  options.most_cells = 100.0;
  options.distance_spacing = 0.5;
  try {
    (void)plan_mate(moved_part(mortise_block(), 10.0, {0, 0, 0}), tenon_plate(), options);
    ADD_FAILURE() << "no node of so coarse a grid lies inside";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), ::testing::AllOf(::testing::HasSubstr("the moving part"),
                                           ::testing::HasSubstr("most cells"),
                                           ::testing::HasSubstr("grid step")));
  }
}

TEST(Mating, RefusesWhatItCannotWorkWith) {
  const auto expect_refused = [](void (*spoil)(MateOptions&), const char* message) {
    MateOptions options = small_options();
    spoil(options);
    try {
      (void)plan_mate(mortise_block(), tenon_plate(), options);
      ADD_FAILURE() << message;
    } catch (const InputError& e) {
      EXPECT_THAT(e.what(), ::testing::HasSubstr(message));
    }
  };
  expect_refused([](MateOptions& o) { o.spacing = 0.0; }, "spacing");
  expect_refused([](MateOptions& o) { o.skin = std::nan(""); }, "skin");
  expect_refused([](MateOptions& o) { o.penalty = 1.0; }, "penalty");
  expect_refused([](MateOptions& o) { o.rotations = 0; }, "rotations");
  for (double MateOptions::*member :
       {&MateOptions::spacing, &MateOptions::most_cells, &MateOptions::separation,
        &MateOptions::skin, &MateOptions::penalty, &MateOptions::feature, &MateOptions::skeletal,
        &MateOptions::distance_spacing, &MateOptions::tolerance, &MateOptions::one_sided_weight,
        &MateOptions::penetration_weight, &MateOptions::cluster_radius})
    for (const double bad : {std::numeric_limits<double>::infinity(), std::nan("")}) {
      MateOptions options = small_options();
      options.*member = bad;
      EXPECT_THROW((void)plan_mate(mortise_block(), tenon_plate(), options), InputError);
    }
  expect_refused(
      [](MateOptions& o) {
        o.axis = MateAxis{Eigen::Vector3d::Zero(), {1, 0, 0}};
      },
      "axis");
  EXPECT_THROW((void)plan_mate(Part{{}, mortise_block().solid}, tenon_plate(), small_options()),
               InputError);
  EXPECT_THROW((void)mate_preset("slow"), InputError);
}

}  // namespace
}  // namespace mortise
