// SPDX-License-Identifier: GPL-3.0-or-later
// Stages of the ranking on poses that a person can follow.
#include "mortise/poses/stages.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "mortise/core/errors.hpp"

namespace mortise {
namespace {

// Scores a pose by f of its x.
class OfX : public PoseScorer {
 public:
  OfX(std::string name, double (*f)(double)) : name_(std::move(name)), f_(f) {}
  [[nodiscard]] std::vector<std::string> columns() const override { return {name_}; }
  [[nodiscard]] Eigen::MatrixXd score(const std::vector<RigidMotion>& poses, int) const override {
    Eigen::MatrixXd result(1, static_cast<Eigen::Index>(poses.size()));
    for (std::size_t i = 0; i < poses.size(); ++i)
      result(0, static_cast<Eigen::Index>(i)) = f_(poses[i].translation.x());
    return result;
  }

 private:
  std::string name_;
  double (*f_)(double);
};

PoseList poses_at(const std::vector<double>& places) {
  PoseList list{{"search"}, {}};
  for (const double x : places) {
    Pose pose;
    pose.moving_in_fixed.translation = {x, 0.0, 0.0};
    pose.score = -x;
    pose.channels = {-x};
    list.poses.push_back(pose);
  }
  return list;
}

std::vector<double> places(const PoseList& list) {
  std::vector<double> result;
  for (const Pose& pose : list.poses) result.push_back(pose.moving_in_fixed.translation.x());
  return result;
}

const Eigen::Matrix3Xd kPoint = Eigen::Vector3d::Zero();

TEST(Stages, AddColumnsToThePosesOwnOrReplaceThem) {
  const auto squares = std::make_shared<OfX>("square", [](double x) { return x * x; });
  const PoseList added =
      run_stages(poses_at({1.0, 3.0, 2.0}), {{.name = "s", .scorer = squares}}, kPoint, 1).list;
  EXPECT_EQ(added.channel_names, (std::vector<std::string>{"search", "square"}));
  EXPECT_EQ(places(added), (std::vector<double>{3.0, 2.0, 1.0}));
  EXPECT_EQ(added.poses[0].channels, (std::vector<double>{-3.0, 9.0}));
  EXPECT_EQ(added.poses[0].score, 6.0);
  EXPECT_EQ(added.poses[2].cluster, 2);
  const PoseList replaced =
      run_stages(poses_at({1.0, 3.0, 2.0}), {{.name = "s", .scorer = squares, .replaces = true}},
                 kPoint, 1)
          .list;
  EXPECT_EQ(replaced.channel_names, std::vector<std::string>{"square"});
  EXPECT_EQ(replaced.poses[0].score, 9.0);
}

TEST(Stages, MoveFirstThenScoreThenKeepTheBestOfEachCluster) {
  const auto doubled = [](const std::vector<RigidMotion>& poses, int) {
    std::vector<RigidMotion> moved = poses;
    for (RigidMotion& m : moved) m.translation *= 2.0;
    return moved;
  };
  const auto self = std::make_shared<OfX>("x", [](double x) { return x; });
  const StagedPoses result = run_stages(
      poses_at({1.0, 1.1, 2.0, 5.0}),
      {{.name = "a", .move = doubled, .scorer = self, .replaces = true, .cluster_radius = 0.5},
       {.name = "b", .keep = 2}},
      kPoint, 1);
  EXPECT_EQ(places(result.list), (std::vector<double>{10.0, 4.0}));  // 2.0 joined 2.2
  EXPECT_EQ(result.seconds.size(), 2U);
}

TEST(Stages, EqualScoresStayInTheOrderGiven) {
  const auto same = std::make_shared<OfX>("same", [](double) { return 1.0; });
  const PoseList list = run_stages(poses_at({3.0, 1.0, 2.0}),
                                   {{.name = "s", .scorer = same, .replaces = true}}, kPoint, 1)
                            .list;
  EXPECT_EQ(places(list), (std::vector<double>{3.0, 1.0, 2.0}));
}

TEST(Stages, RefuseAnswersThatAreNone) {
  const auto nan = std::make_shared<OfX>(
      "nan", [](double x) { return x > 1.0 ? std::numeric_limits<double>::quiet_NaN() : x; });
  EXPECT_THROW((void)run_stages(poses_at({1.0, 2.0}), {{.name = "n", .scorer = nan}}, kPoint, 1),
               InputError);
  const auto loses = [](const std::vector<RigidMotion>& poses, int) {
    return std::vector<RigidMotion>(poses.begin() + 1, poses.end());
  };
  EXPECT_THROW((void)run_stages(poses_at({1.0, 2.0}), {{.name = "l", .move = loses}}, kPoint, 1),
               InputError);
}

TEST(Stages, AScorerWithoutGradientSaysSo) {
  const OfX scorer("x", [](double x) { return x; });
  EXPECT_FALSE(scorer.has_gradient());
  EXPECT_THROW((void)scorer.gradient({}), InputError);
}

}  // namespace
}  // namespace mortise
