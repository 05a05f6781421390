// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What surfaces of atoms ask of the atoms.
#pragma once

#include <Eigen/Core>
#include <string>

#include "mortise/core/errors.hpp"

namespace mortise {

/// @throws InputError "<where>..." unless there is one radius per centre, all finite, radii >= 0
inline void check_balls(const std::string& where, const Eigen::Matrix3Xd& centres,
                        const Eigen::VectorXd& radii) {
  if (centres.cols() != radii.size())
    throw InputError(where + "expected one radius per centre, found " +
                     std::to_string(radii.size()) + " radii for " + std::to_string(centres.cols()) +
                     " centres");
  if (!centres.allFinite() || !radii.allFinite())
    throw InputError(where + "expected finite centres and radii");
  if (radii.size() > 0 && !(radii.minCoeff() >= 0.0))
    throw InputError(where + "radii must be >= 0, got " + std::to_string(radii.minCoeff()));
}

}  // namespace mortise
