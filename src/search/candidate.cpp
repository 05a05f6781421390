// SPDX-License-Identifier: GPL-3.0-or-later
// Candidates as motions.
#include "mortise/search/candidate.hpp"

namespace mortise {

RigidMotion candidate_motion(const Candidate& candidate, const CandidateFrames& frames) {
  const Eigen::Vector4d q = frames.rotations.col(candidate.rotation_index);
  const RigidMotion placed{
      Eigen::Quaterniond(q[0], q[1], q[2], q[3]),
      {candidate.translation[0], candidate.translation[1], candidate.translation[2]}};
  return compose(inverse(frames.search_from_fixed), compose(placed, frames.search_from_moving));
}

}  // namespace mortise
