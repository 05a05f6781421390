// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A body's contact potential on a grid: scoring a pose in microseconds.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "mortise/core/rigid_motion.hpp"
#include "mortise/search/contact_potential.hpp"

namespace mortise {

/// Points with a type each; a negative type takes no part.
struct TypedPoints {
  Eigen::Matrix3Xd points;  ///< 3 x N, the body's input frame, angstrom
  Eigen::VectorXi types;    ///< N
};

struct ScoreMapsOptions {
  double spacing = 1.0;  ///< of the grid, angstrom; > 0. Values in between are interpolated
                         ///< linearly in each axis
  int threads = 0;       ///< 0 = all cores; never changes the result
};

/// For each type the potential that the fixed body's points make, on a grid around it.
///
/// Interpolation errs by at most about spacing^2 / 8 times the kernels' curvature, which is
/// concentrated in their corners; at 1 angstrom a pose's score errs by about 2% (docs/math.md).
class ScoreMaps {
 public:
  /// @throws InputError if a type is not below the potential's, a size does not fit, or an option
  /// is out of range
  ScoreMaps(const TypedPoints& fixed, const ContactPotential& potential,
            const ScoreMapsOptions& options = {});

  /// sum_ij near K1 + far K2 over fixed points i and moved points j; without the shape term.
  /// Time O(moving points within range). Thread safe.
  [[nodiscard]] double score(const TypedPoints& moving, const RigidMotion& moving_in_fixed) const;

 private:
  std::array<int, 3> size_;
  Eigen::Vector3d low_;  // of grid point 0
  double spacing_;
  int types_;
  std::vector<float> values_;  // types x nx x ny x nz
};

/// The same score by the sum over all pairs: slow, exact.
[[nodiscard]] double contact_score(const TypedPoints& fixed, const TypedPoints& moving,
                                   const RigidMotion& moving_in_fixed,
                                   const ContactPotential& potential);

}  // namespace mortise
