// SPDX-License-Identifier: GPL-3.0-or-later
// Molecules' scores by maps.
#include "scoring/molecule_scorers.hpp"

namespace mortise {

Eigen::MatrixXd MapScorer::score(const std::vector<RigidMotion>& poses, int threads) const {
  return maps_->contact_scores(moving_, poses, threads).transpose();
}

PlacedScore MapScorer::gradient(const RigidMotion& moving_in_fixed) const {
  if (!has_gradient()) return PoseScorer::gradient(moving_in_fixed);
  return maps_->slope(moving_, moving_in_fixed);
}

}  // namespace mortise
