// SPDX-License-Identifier: GPL-3.0-or-later
// Finite rotation groups, for sets with symmetry.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <string>
#include <vector>

namespace mortise {

/// Every product of the generators: canonical quaternions, the identity first, in a fixed order.
/// The generators must span a group of at most 1,000 rotations.
[[nodiscard]] std::vector<Eigen::Quaterniond> generate_group(
    const std::vector<Eigen::Quaterniond>& generators);

/// Cn (n-fold about z), Dn (and a 2-fold about x), T, O or I: 12, 24 or 60 rotations.
/// @throws InputError for any other name
[[nodiscard]] std::vector<Eigen::Quaterniond> rotation_group(const std::string& name);

}  // namespace mortise
