// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Dropping balls that lie in others.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace mortise {

/// Balls that lie in no other kept ball whose radius is grown: visited by decreasing radius (equal
/// ones in their order), ball i is dropped if |x_i - x_k| <= r_k + growth - r_i for a ball k kept
/// before. So every dropped ball lies in one grown kept ball [SD, Eq. A.4; the rule of
/// docs/math.md].
/// @param balls   4 x N: centre and radius >= 0, any unit
/// @param growth  >= 0, same unit; 0 = drop only what changes nothing
/// @return indices of the kept balls, by decreasing radius
/// @throws InputError if a ball is not finite, a radius or the growth is negative
/// Time about O(N log N) for balls spread in space.
[[nodiscard]] std::vector<Eigen::Index> uncontained_balls(const Eigen::Matrix4Xd& balls,
                                                          double growth = 0.0);

}  // namespace mortise
