// SPDX-License-Identifier: GPL-3.0-or-later
// The atoms that reports show.
#pragma once

#include "mortise/molecules/molecule.hpp"

namespace mortise::detail {

// The molecule without its hydrogens.
[[nodiscard]] Molecule heavy_atoms(const Molecule& molecule);

}  // namespace mortise::detail
