// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Poses of two rigid bodies measured against a known complex: i-RMSD, L-RMSD, fnat, DockQ, CAPRI
/// class.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "mortise/core/rigid_motion.hpp"
#include "mortise/metrics/match_residues.hpp"
#include "mortise/metrics/quality.hpp"
#include "mortise/molecules/molecule.hpp"

namespace mortise {

/// Which body L-RMSD is measured on, after superposing the other one.
enum class LigandChoice {
  kMoving,   ///< always the moving body
  kSmaller,  ///< the body with fewer residues in the reference, as CAPRI and DockQ have it; the
             ///< moving one if equal
};

struct ReferenceComplexOptions {
  double contact_cutoff =
      5.0;  ///< angstrom: heavy atoms closer than this make a residue contact; > 0
  double interface_cutoff =
      10.0;  ///< angstrom: heavy atoms closer than this make interface residues; > 0
  LigandChoice ligand = LigandChoice::kMoving;
  MatchResiduesOptions match = {};
};

/// What of the reference the model can be measured on.
struct ReferenceSummary {
  ResidueMatch fixed;
  ResidueMatch moving;
  std::size_t interface_residues = 0;  ///< in the reference, both bodies
  std::size_t interface_residues_matched =
      0;  ///< of these, in the model too: i-RMSD runs over their backbones
  std::size_t native_contacts = 0;          ///< in the reference: what fnat is a fraction of
  std::size_t native_contacts_matched = 0;  ///< of these, between residues the model has
  bool ligand_is_moving = true;
};

/// A model (two rigid bodies, unbound or bound) and the complex it should become; measures any pose
/// in microseconds.
///
/// Definitions: Mendez, Leplae, De Maria, Wodak, Proteins 52 (2003) 51-67, with DockQ's details
/// (see quality.hpp). Only heavy atoms of amino acids and nucleotides count. Atoms pair by
/// match_residues and by name.
///  - i-RMSD: backbone of the reference's interface residues, after superposing just these atoms.
///    Interface residues have an atom within interface_cutoff of the partner. Backbone is N, CA, C,
///    O; for nucleotides the sugar and phosphate atoms, as in DockQ 2.
///  - L-RMSD: backbone of the whole ligand after superposing the backbone of the whole receptor.
///  - fnat: share of the reference's contacts that the pose has. A contact is a pair of residues
///    with atoms closer than contact_cutoff; those of residues that the model lacks count as
///    missed.
///  - fnonnat: share of the pose's contacts, among residues known to both, that the reference does
///    not have.
///
/// Immutable and cheap to copy; evaluate() may run in many threads at once.
class ReferenceComplex {
 public:
  /// @param fixed, moving  the model, each in its own input frame, angstrom
  /// @param reference_fixed, reference_moving  the complex, both in one frame of its own
  /// @throws InputError if residues do not match (see match_residues), the reference's bodies make
  /// no contact, no matched
  ///         residue of a body is at the interface, or an option is out of range
  ReferenceComplex(const Molecule& fixed, const Molecule& moving, const Molecule& reference_fixed,
                   const Molecule& reference_moving, const ReferenceComplexOptions& options = {});

  /// @param moving_in_fixed  carries the moving model's input coordinates into the fixed model's
  /// input frame
  /// @throws InputError if the motion is not finite or its quaternion's norm is off 1 by more than
  /// 1e-6 Time: RMSDs O(1), contacts O(residues + atoms near the interface).
  [[nodiscard]] ComplexMetrics evaluate(const RigidMotion& moving_in_fixed) const;

  /// The pose with each model body superposed on its own reference: about the best a rigid search
  /// can find.
  [[nodiscard]] RigidMotion superposed_pose() const;

  [[nodiscard]] const ReferenceSummary& summary() const;

 private:
  struct Impl;
  std::shared_ptr<const Impl> impl_;
};

/// evaluate() of every pose, in their order. @param threads  0 = all cores; never changes the
/// result
[[nodiscard]] std::vector<ComplexMetrics> evaluate_poses(const ReferenceComplex& reference,
                                                         const std::vector<RigidMotion>& poses,
                                                         int threads = 0);

}  // namespace mortise
