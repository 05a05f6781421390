// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Solids whose distance is a formula, and their unions.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "mortise/parts/solid.hpp"

namespace mortise {

/// @throws InputError unless the centre is finite and radius > 0
[[nodiscard]] std::shared_ptr<const Solid> make_ball(const Eigen::Vector3d& center, double radius);

/// The axis-parallel box between two corners. @throws InputError unless low < high in each
/// coordinate
[[nodiscard]] std::shared_ptr<const Solid> make_box(const Eigen::Vector3d& low,
                                                    const Eigen::Vector3d& high);

/// All points within `radius` of the segment from a to b. @throws InputError unless radius > 0
[[nodiscard]] std::shared_ptr<const Solid> make_capsule(const Eigen::Vector3d& a,
                                                        const Eigen::Vector3d& b, double radius);

/// All points within `tube` of the circle of `radius` about the z axis through the centre.
/// @throws InputError unless 0 < tube < radius
[[nodiscard]] std::shared_ptr<const Solid> make_torus(const Eigen::Vector3d& center, double radius,
                                                      double tube);

/// The union of solids. Outside exact; inside where solids overlap the depth is that in the deepest
/// of them, a lower bound. @throws InputError if there is none
[[nodiscard]] std::shared_ptr<const Solid> unite(std::vector<std::shared_ptr<const Solid>> solids);

}  // namespace mortise
