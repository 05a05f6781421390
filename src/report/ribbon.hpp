// SPDX-License-Identifier: GPL-3.0-or-later
// A chain's course as a flat band.
#pragma once

#include "mortise/molecules/molecule.hpp"
#include "mortise/parts/triangle_mesh.hpp"

namespace mortise::detail {

// Bands along the residues of a molecule: cubic B-splines through the neighbourhood of the CA (or
// P) atoms, laid in the peptide planes (M. Carson, C. E. Bugg, J. Mol. Graphics 4 (1986) 121-122).
// No triangle if no four such atoms follow each other.
[[nodiscard]] TriangleMesh ribbon(const Molecule& molecule);

}  // namespace mortise::detail
