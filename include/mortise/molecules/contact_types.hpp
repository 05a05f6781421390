// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The kinds of atoms that a contact potential tells apart.
#pragma once

#include <Eigen/Core>
#include <array>
#include <string_view>

#include "mortise/molecules/molecule.hpp"

namespace mortise {

inline constexpr int kContactTypes = 22;

/// What each type stands for, in the order of the types.
inline constexpr std::array<std::string_view, kContactTypes> kContactTypeNames = {
    "N backbone",    "CA",
    "C backbone",    "O backbone",
    "CA Gly",        "C polar side chain",
    "CB apolar",     "NZ Lys",
    "CD CE Lys Arg", "NE CZ Arg",
    "NH Arg",        "O carboxyl",
    "C carboxyl",    "O amide",
    "N C amide",     "O hydroxyl",
    "ring His",      "ring Tyr",
    "ring Phe",      "ring Trp",
    "Met Cys",       "aliphatic Leu Ile Val"};

/// Type of one heavy atom, 0 to kContactTypes - 1; -1 for atoms of other residues than the 20 amino
/// acids and MSE, and for hydrogens.
[[nodiscard]] int contact_type(const Atom& atom);

/// N types, one per atom.
[[nodiscard]] Eigen::VectorXi contact_types(const Molecule& molecule);

}  // namespace mortise
