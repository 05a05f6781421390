// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Distances of many points from one body.
#pragma once

#include <Eigen/Core>

#include "mortise/parts/solid.hpp"

namespace mortise {

/// Solid::signed_distance in pieces, so that all threads work.
[[nodiscard]] Eigen::VectorXd distances(const Solid& solid, const Eigen::Matrix3Xd& points,
                                        double band, int threads);

}  // namespace mortise
