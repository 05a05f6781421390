// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A union of balls as a solid: a molecule's surface, or knots again.
#pragma once

#include <Eigen/Core>
#include <memory>

#include "mortise/parts/solid.hpp"

namespace mortise {

/// The union of balls. With atoms and their radii the van der Waals surface of a molecule bounds
/// it, with radii grown by a probe's the solvent-accessible one.
///
/// Distances are exact on both sides. The boundary is made of patches of spheres, of arcs in which
/// two spheres meet, and of the arcs' ends. From inside, a tree finds the nearest of these. Copies
/// share the tree. Safe to call from several threads at once.
class BallUnion : public Solid {
 public:
  /// @param balls  4 x N, N >= 1: centre and radius > 0
  /// @throws InputError if there is no ball, something is not finite or a radius not > 0
  /// Time and memory about O(N k^2), k = balls that one meets.
  explicit BallUnion(const Eigen::Matrix4Xd& balls);

  [[nodiscard]] Eigen::AlignedBox3d bounds() const override;
  [[nodiscard]] Eigen::VectorXd signed_distance(const Eigen::Matrix3Xd& points,
                                                double band) const override;

 private:
  struct State;
  std::shared_ptr<const State> state_;
};

}  // namespace mortise
