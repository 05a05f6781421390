// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Molecules' scores by maps: the contact potential, and shape with contact for polish.
#pragma once

#include <memory>
#include <optional>

#include "mortise/scoring/pose_scorer.hpp"
#include "mortise/scoring/score_maps.hpp"

namespace mortise {

/// Column "contact": the contact potential of the typed points by the fixed body's maps, linear
/// between grid points. The gradient is that of shape and contact together, by the same maps'
/// smooth interpolation (ScoreMaps::smooth_score); it needs maps with a shape and `placed`.
class MapScorer : public PoseScorer {
 public:
  MapScorer(std::shared_ptr<const ScoreMaps> maps, TypedPoints moving,
            std::optional<PlacedPoints> placed)
      : maps_(std::move(maps)), moving_(std::move(moving)), placed_(std::move(placed)) {}

  [[nodiscard]] std::vector<std::string> columns() const override { return {"contact"}; }
  [[nodiscard]] Eigen::MatrixXd score(const std::vector<RigidMotion>& poses,
                                      int threads) const override;
  [[nodiscard]] bool has_gradient() const override { return placed_.has_value(); }
  [[nodiscard]] PlacedScore gradient(const RigidMotion& moving_in_fixed) const override;
  /// The moving body's points for polish; none = maps without a shape.
  [[nodiscard]] const std::optional<PlacedPoints>& placed() const { return placed_; }

 private:
  std::shared_ptr<const ScoreMaps> maps_;
  TypedPoints moving_;
  std::optional<PlacedPoints> placed_;
};

}  // namespace mortise
