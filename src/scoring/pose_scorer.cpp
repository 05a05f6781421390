// SPDX-License-Identifier: GPL-3.0-or-later
// What a scorer without a gradient answers.
#include "mortise/scoring/pose_scorer.hpp"

#include "mortise/core/errors.hpp"

namespace mortise {

PlacedScore PoseScorer::gradient(const RigidMotion&) const {
  throw InputError("this score of poses has no gradient");
}

}  // namespace mortise
