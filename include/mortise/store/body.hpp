// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// One of the two bodies of a run, whatever its file holds: a molecule, a part or balls.
#pragma once

#include <Eigen/Core>
#include <string>
#include <variant>
#include <vector>

#include "mortise/core/knots.hpp"
#include "mortise/core/rigid_motion.hpp"
#include "mortise/molecules/molecule.hpp"
#include "mortise/molecules/read_molecule.hpp"
#include "mortise/parts/part.hpp"
#include "mortise/parts/read_part.hpp"
#include "mortise/store/inputs.hpp"
#include "mortise/store/run_file.hpp"

namespace mortise {

/// A body in its own frame and length unit.
struct Body {
  Body() = default;
  Body(Molecule molecule);  // NOLINT: a molecule is a body
  Body(Part part);          // NOLINT
  Body(Knots balls);        // NOLINT

  /// Molecule, part, or balls of real weights.
  std::variant<Molecule, Part, Knots> shape;
  BodyRecord record;                        ///< its file, without knots
  std::vector<std::string> decisions = {};  ///< of reading it, one line each, for people
  double deviation = 0.0;  ///< of a STEP file's triangles from its surface, length unit; else 0

  [[nodiscard]] const Molecule* molecule() const { return std::get_if<Molecule>(&shape); }
  [[nodiscard]] const Part* part() const { return std::get_if<Part>(&shape); }
  [[nodiscard]] const Knots* balls() const { return std::get_if<Knots>(&shape); }
};

struct ReadBodyOptions {
  ReadMoleculeOptions molecule = {};
  ReadPartOptions part = {};
  int threads = 0;  ///< for parts' search trees; 0 = all cores; never changes the result
};

/// What read_body() takes a file for.
enum class BodyKind { kMolecule, kPart, kBalls };

/// By its name's ending; by its first bytes where the ending says nothing.
/// @param spec  as read_body() takes it @throws FileError if the file is needed and unreadable
[[nodiscard]] BodyKind body_kind(const std::string& spec);

/// "molecule", "part", "balls".
[[nodiscard]] const char* name_of(BodyKind kind);

/// The file that a spec names.
[[nodiscard]] std::string body_path(const std::string& spec);

/// Reads a body.
/// @param spec  a mesh or STEP file, a file of `mortise decompose`, an .xyzr file, or a molecule:
/// path[#model][:chain,chain]
/// @throws as read_part(), read_balls() and read_molecule(); InputError if model or chains are
/// given for what is no molecule
[[nodiscard]] Body read_body(const std::string& spec, const ReadBodyOptions& options = {});

/// Reads a body of an earlier run again, its checksum verified.
/// @param name    "fixed" or "moving", for messages
/// @param where   where it may be now: a path, for molecules with the run's model and chains
/// @throws as locate_input() and read_body(); InputError if another model or other chains are meant
[[nodiscard]] Body read_recorded_body(const BodyRecord& record, const Provenance& provenance,
                                      const std::string& name, const LocateOptions& where = {},
                                      const ReadBodyOptions& options = {});

/// The same to look at or to measure, even where this program does not know the run's options:
/// hydrogens included, waters not; parts tessellated as the run's were, open surfaces accepted.
[[nodiscard]] Body read_input_body(const BodyRecord& record, const Provenance& provenance,
                                   const std::string& name, const LocateOptions& where = {});

/// The body under a rigid motion; its record and decisions stay.
[[nodiscard]] Body moved_body(const Body& body, const RigidMotion& motion);

/// The body's surface to look at: a part's mesh, the balls of the others as ball_mesh() makes them.
[[nodiscard]] TriangleMesh body_mesh(const Body& body);

}  // namespace mortise
