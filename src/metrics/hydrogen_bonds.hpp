// SPDX-License-Identifier: GPL-3.0-or-later
// Which atoms can take part in hydrogen bonds, and whether two of them do.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "mortise/molecules/molecule.hpp"

namespace mortise::detail {

struct PolarAtom {
  bool donor = false;
  bool acceptor = false;
  Eigen::Matrix3Xd bonded = Eigen::Matrix3Xd(3, 0);  // unit vectors to the heavy atoms bonded to it

  [[nodiscard]] bool polar() const { return donor || acceptor; }
};

// One per atom of `heavy`, a molecule without hydrogens.
[[nodiscard]] std::vector<PolarAtom> polar_atoms(const Molecule& heavy);

// No atom bonded to `atom` makes an angle at it, with the direction `towards` (not zero, in the
// frame of atom.bonded), of a cosine above `most`.
[[nodiscard]] bool faces(const PolarAtom& atom, const Eigen::Vector3d& towards, double most);

}  // namespace mortise::detail
