// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Least-squares superposition of paired points.
#pragma once

#include <Eigen/Core>

#include "mortise/core/rigid_motion.hpp"

namespace mortise {

/// The best rigid motion from one point set to another and what it leaves.
struct Superposition {
  RigidMotion motion;  ///< carries the model's points onto the reference's
  double rmsd = 0.0;   ///< after the motion; length unit of the points
};

/// Finds the proper rigid motion m that minimises sum_k |m model_k - reference_k|^2: Horn's
/// quaternion method, J. Opt. Soc. Am. A 4 (1987) 629-642.
///
/// @param model, reference  3 x N, N >= 1, column k of one belongs to column k of the other
/// @throws InputError if the sets are empty, differ in size or hold a value that is not finite
/// Time O(N). For collinear sets the rotation is one of the many best.
[[nodiscard]] Superposition superpose(const Eigen::Matrix3Xd& model,
                                      const Eigen::Matrix3Xd& reference);

/// sqrt(mean_k |a_k - b_k|^2) as the points stand. @throws InputError as superpose
[[nodiscard]] double rmsd(const Eigen::Matrix3Xd& a, const Eigen::Matrix3Xd& b);

}  // namespace mortise
