// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Molecules' scores by maps: the contact potential, and shape with contact for polish.
#pragma once

#include <memory>

#include "mortise/scoring/pose_scorer.hpp"
#include "mortise/scoring/score_maps.hpp"

namespace mortise {

/// Column "contact": the contact potential of the typed points by the fixed body's maps. The
/// gradient is that of shape and contact together by the same maps (ScoreMaps::slope), if they have
/// a shape.
class MapScorer : public PoseScorer {
 public:
  MapScorer(std::shared_ptr<const ScoreMaps> maps, PlacedPoints moving)
      : maps_(std::move(maps)), moving_(std::move(moving)) {}

  [[nodiscard]] std::vector<std::string> columns() const override { return {"contact"}; }
  [[nodiscard]] Eigen::MatrixXd score(const std::vector<RigidMotion>& poses,
                                      int threads) const override;
  [[nodiscard]] bool has_gradient() const override { return maps_->shapes() > 0; }
  [[nodiscard]] PlacedScore gradient(const RigidMotion& moving_in_fixed) const override;
  [[nodiscard]] const PlacedPoints& placed() const { return moving_; }

 private:
  std::shared_ptr<const ScoreMaps> maps_;
  PlacedPoints moving_;
};

}  // namespace mortise
