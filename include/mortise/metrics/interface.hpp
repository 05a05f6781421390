// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What holds two molecules together in a pose: contacts, hydrogen bonds, buried area, fit.
#pragma once

#include <cstddef>
#include <memory>
#include <numbers>
#include <vector>

#include "mortise/core/rigid_motion.hpp"
#include "mortise/metrics/shape_complementarity.hpp"
#include "mortise/molecules/molecule.hpp"

namespace mortise {

struct InterfaceOptions {
  double contact_cutoff = 5.0;  ///< angstrom: heavy atoms closer than this are in contact; > 0
  double clash_cutoff = 3.0;    ///< angstrom: heavy atoms closer than this clash, hydrogen bonds
                                ///< excepted; > 0
  double hydrogen_bond_length = 3.5;  ///< angstrom: most from donor to acceptor; > 0
  double hydrogen_bond_angle =
      std::numbers::pi / 2;        ///< radians: least angle at donor and acceptor; in [0, pi]
  double water_radius = 1.4;       ///< angstrom: of the probe for the buried area; >= 0
  int points_per_atom = 200;       ///< for the buried area; >= 1
  bool complementarity = true;     ///< false: no Sc, which takes most of the time
  ComplementarityOptions sc = {};  ///< its threads are not used
  int threads = 0;  ///< in making the surfaces; 0 = all cores; never changes the result
};

/// Two residues, one of each body, with heavy atoms in contact.
struct ResidueContact {
  std::size_t fixed = 0, moving = 0;  ///< indices into residues(molecule)
  double distance = 0.0;              ///< of their closest heavy atoms, angstrom
};

struct HydrogenBond {
  std::size_t fixed = 0, moving = 0;  ///< indices of the atoms in their molecules
  bool fixed_donates = false;         ///< where both could: true
  double distance = 0.0;              ///< donor to acceptor, angstrom
};

struct InterfaceDescription {
  std::vector<ResidueContact> residue_contacts;  ///< by fixed, then moving residue
  std::vector<HydrogenBond> hydrogen_bonds;      ///< by moving, then fixed atom
  std::size_t atom_contacts = 0;                 ///< pairs of heavy atoms in contact
  std::size_t clashes = 0;                       ///< pairs of heavy atoms
  double buried_area = 0.0;  ///< accessible area both bodies lose, square angstrom
  double fixed_buried_area = 0.0, moving_buried_area = 0.0;  ///< what each loses
  Complementarity shape;  ///< Sc; NaN where not asked for or without interface

  /// Half of the buried area: one side's share.
  [[nodiscard]] double interface_area() const noexcept { return 0.5 * buried_area; }
};

/// Two rigid molecules; describes any pose in milliseconds, as what belongs to one body alone (its
/// surfaces, its polar atoms) is made once and moved.
///
/// Only heavy atoms count, hetero groups included, with their atom_radii() (Sc:
/// complementarity_radii()).
///  - clash: nearer than 3 A, as CAPRI counts them (Mendez, Leplae, De Maria, Wodak, Proteins 52
///    (2003) 51-67), but for pairs that are hydrogen bonds.
///  - hydrogen bond: donor and acceptor at most 3.5 A apart (E. N. Baker, R. E. Hubbard, Prog.
///    Biophys. Mol. Biol. 44 (1984) 97-179), and no heavy atom bonded to either makes an angle
///    below 90 degrees with the other, at donor and acceptor (I. K. McDonald, J. M. Thornton, J.
///    Mol. Biol. 238 (1994) 777-793, their criteria without hydrogens). Donors and acceptors are N
///    and O by residue and atom name; both ring N of His may be either, as may any N and O of
///    residues that are neither amino acids nor nucleotides. Sulphur is neither.
///  - buried area: accessible area (water 1.4 A) of both bodies alone less that of the complex.
///
/// Immutable and cheap to copy; describe() may run in many threads at once.
class MolecularInterface {
 public:
  /// @throws InputError if a molecule has no heavy atom or an option is out of range
  MolecularInterface(const Molecule& fixed, const Molecule& moving,
                     const InterfaceOptions& options = {});

  /// @param moving_in_fixed  carries the moving molecule's coordinates into the fixed one's frame
  /// @throws InputError if the motion is not finite or its quaternion's norm is off 1 by more than
  /// 1e-6
  [[nodiscard]] InterfaceDescription describe(const RigidMotion& moving_in_fixed) const;

 private:
  struct Impl;
  std::shared_ptr<const Impl> impl_;
};

/// describe() of every pose, in their order. @param threads  0 = all cores; never changes the
/// result
[[nodiscard]] std::vector<InterfaceDescription> describe_poses(
    const MolecularInterface& interface, const std::vector<RigidMotion>& poses, int threads = 0);

}  // namespace mortise
