// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What every score of poses looks like.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "mortise/core/rigid_motion.hpp"

namespace mortise {

/// A score and how it changes as the moving body moves: force by its translation, per length unit;
/// torque by its rotation about its moved centre, fixed frame, per radian.
struct PlacedScore {
  double value = 0.0;
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  Eigen::Vector3d torque = Eigen::Vector3d::Zero();
};

/// A score of poses: named columns whose sum is the score; higher is better. One body pair each;
/// what it needs of them it holds. Safe to call from several threads at once.
///
/// A new score is one class derived from this one; a run takes it as a Stage (poses/stages.hpp).
/// examples/own_scorer.cpp is one.
class PoseScorer {
 public:
  virtual ~PoseScorer() = default;

  /// Names of the columns; unique among the scorers of one run.
  [[nodiscard]] virtual std::vector<std::string> columns() const = 0;

  /// The columns of each pose: columns() x N.
  /// @param poses    N motions of the moving body's input frame into the fixed body's
  /// @param threads  0 = all cores; never changes the result
  [[nodiscard]] virtual Eigen::MatrixXd score(const std::vector<RigidMotion>& poses,
                                              int threads) const = 0;

  /// Whether gradient() answers.
  [[nodiscard]] virtual bool has_gradient() const { return false; }

  /// A smooth version of the score and its derivatives, for polish.
  /// @throws InputError unless has_gradient()
  [[nodiscard]] virtual PlacedScore gradient(const RigidMotion& moving_in_fixed) const;

 protected:
  PoseScorer() = default;
  PoseScorer(const PoseScorer&) = default;
  PoseScorer& operator=(const PoseScorer&) = default;
};

/// Moves poses, each by itself: N motions in, N out, as PoseScorer::score() takes them.
using MovePoses =
    std::function<std::vector<RigidMotion>(const std::vector<RigidMotion>& poses, int threads)>;

}  // namespace mortise
