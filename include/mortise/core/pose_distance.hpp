// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// How far apart two poses of one rigid body are, in constant time.
#pragma once

#include <Eigen/Core>

#include "mortise/core/rigid_motion.hpp"

namespace mortise {

/// RMSD between two placements of the same N points, exactly, from the points' centroid and inertia
/// alone.
///
/// With c the centroid, J = mean(|p~|^2 I - p~ p~^T) the inertia per point about it and (w, v) the
/// unit quaternion of Ra^T Rb:
///
///   mean_k |a p_k - b p_k|^2 = |a c - b c|^2 + 4 v^T J v.
///
/// p~ = p - c sums to zero, so centroid and rotation separate. |Ra p~ - Rb p~|^2 is 2 p~^T (I -
/// Ra^T Rb) p~, in which only the symmetric part 2 (|v|^2 I - v v^T) of I - Ra^T Rb counts. No
/// large numbers are subtracted, so close poses are exact too.
class PoseDistance {
 public:
  /// @param points  3 x N, N >= 1: the moving body in its input frame
  /// @throws InputError if there is no point or one is not finite
  explicit PoseDistance(const Eigen::Matrix3Xd& points);

  /// The same for weighted points: mean square distances are weighted means.
  /// @param weights  N, >= 0, dimensionless; their sum > 0
  /// @throws InputError as above, or if the weights do not fit
  PoseDistance(const Eigen::Matrix3Xd& points, const Eigen::VectorXd& weights);

  /// Mean square distance of corresponding points in the two poses, square of the points' unit.
  /// Time O(1), no allocation.
  [[nodiscard]] double mean_square(const RigidMotion& a, const RigidMotion& b) const {
    const Eigen::Vector3d step = a * centroid_ - b * centroid_;
    const Eigen::Vector3d v = (a.rotation.conjugate() * b.rotation).vec();
    return step.squaredNorm() + 4.0 * v.dot(inertia_ * v);
  }

  /// Root of mean_square: the pairwise ligand RMSD, without superposition.
  [[nodiscard]] double rmsd(const RigidMotion& a, const RigidMotion& b) const;

  [[nodiscard]] const Eigen::Vector3d& centroid() const noexcept { return centroid_; }
  [[nodiscard]] const Eigen::Matrix3d& inertia() const noexcept { return inertia_; }

 private:
  Eigen::Vector3d centroid_;
  Eigen::Matrix3d inertia_;  // per point, about the centroid
};

}  // namespace mortise
