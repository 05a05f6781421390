// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A pair potential between typed points, as a table.
#pragma once

#include <Eigen/Core>
#include <string>

namespace mortise {

/// Score of two bodies of typed points: sum_ij near(a_i, b_j) K1(d_ij) + far(a_i, b_j) K2(d_ij),
/// higher is better, and what the shape score counts beside it. K1 is 1 up to 5 angstrom and falls
/// to 0 at 7; K2 rises from 5 to 7, is 1 up to 8.5 and falls to 0 at 9.5. Wide, straight-sided
/// steps forgive the errors of a coarse search and of unbound side chains. How the tables are
/// fitted: docs/ranking.md.
struct ContactPotential {
  double shape = 0.0;    ///< factor of the shape score
  Eigen::MatrixXd near;  ///< T x T, symmetric
  Eigen::MatrixXd far;   ///< T x T, symmetric
};

inline constexpr double kContactRange =
    9.5;  ///< distance from which on both kernels are 0, angstrom

/// K1 at distance d >= 0.
[[nodiscard]] double near_contact(double d);
/// K2 at distance d >= 0.
[[nodiscard]] double far_contact(double d);

/// Potential of kContactTypes types fitted to the training pairs, part of the library.
[[nodiscard]] const ContactPotential& fitted_contact_potential();

/// Parses a table: lines of "#" comments, then "shape VALUE", "near" and T rows of T numbers, "far"
/// and the same.
/// @param name  what errors call the text; lines are counted from 1
/// @throws FileError if the text is not such a table for `types` types or is not symmetric
[[nodiscard]] ContactPotential parse_contact_potential(const std::string& text, int types,
                                                       const std::string& name);

/// The same from a file.
[[nodiscard]] ContactPotential read_contact_potential(const std::string& path, int types);

}  // namespace mortise
