// SPDX-License-Identifier: GPL-3.0-or-later
// Molecules' scores by maps.
#include "scoring/molecule_scorers.hpp"

#include <algorithm>

#include "mortise/core/threads.hpp"

namespace mortise {

Eigen::MatrixXd MapScorer::score(const std::vector<RigidMotion>& poses, int threads) const {
  Eigen::MatrixXd columns(1, static_cast<Eigen::Index>(poses.size()));
  // Pieces large enough that handing them out costs nothing.
  constexpr std::size_t kPiece = 256;
  parallel_for((poses.size() + kPiece - 1) / kPiece, threads, [&](std::size_t piece, int) {
    const std::size_t end = std::min(poses.size(), (piece + 1) * kPiece);
    for (std::size_t i = piece * kPiece; i < end; ++i)
      columns(0, static_cast<Eigen::Index>(i)) = maps_->score(moving_, poses[i]);
  });
  return columns;
}

PlacedScore MapScorer::gradient(const RigidMotion& moving_in_fixed) const {
  if (!placed_) return PoseScorer::gradient(moving_in_fixed);
  return maps_->smooth_score(*placed_, moving_in_fixed);
}

}  // namespace mortise
