// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Molecules as knots: one ball per heavy atom, weighted by where it sits.
#pragma once

#include "mortise/core/knots.hpp"
#include "mortise/molecules/molecule.hpp"

namespace mortise {

struct ToKnotsOptions {
  double radius = 1.8;  ///< of every heavy atom's knot, angstrom; 0 = each atom's own atom_radius()
  double propensity = 0.7;  ///< strength of the interface propensities; 0 = all weights are 1
  double exposed_area =
      1.0;  ///< accessible area above which an atom counts as exposed, square angstrom; >= 0
  double merge_buried = 0.0;  ///< buried atoms are merged into balls up to this radius, angstrom
                              ///< (merge_buried.hpp); 0 = one knot per atom
  double offset = 1.4;  ///< r0 of the double skin, by which merged knots are weighted, angstrom
  int threads = 1;      ///< 0 = all cores; never changes the result
};

/// Logarithm of how much more often a residue is seen in interfaces than on the rest of the
/// surface; 0 for others than the 20 amino acids (and MSE). S. Jones, J. M. Thornton, J. Mol. Biol.
/// 272 (1997) 121-132.
[[nodiscard]] double interface_propensity(const std::string& residue_name);

/// One knot per heavy atom, in atom order and then merged as the option says, with real weight 1 +
/// propensity * interface_propensity(residue) for exposed side-chain atoms and 1 for all others.
/// @throws InputError if there is no heavy atom or an option is out of range
[[nodiscard]] Knots to_knots(const Molecule& molecule, const ToKnotsOptions& options = {});

}  // namespace mortise
