// SPDX-License-Identifier: GPL-3.0-or-later
// Reading molecules, random start, docking.
#include "docking_job.hpp"

#include <chrono>

#include "mortise/core/errors.hpp"
#include "mortise/store/inputs.hpp"

namespace mortise::app {
namespace {

// The recorded model and chains, under another path. The recorded file itself may be gone, so its
// name is spared from being looked up.
MoleculeSpec recorded_spec(const BodyRecord& record, const std::string& path) {
  MoleculeSpec spec = record.spec.compare(0, record.path.size(), record.path) == 0
                          ? parse_molecule_spec("body.pdb" + record.spec.substr(record.path.size()))
                          : parse_molecule_spec(record.spec);
  spec.path = path;
  return spec;
}

DockBody read_body(const BodyRecord& record, const MoleculeSpec& spec,
                   const ReadMoleculeOptions& options) {
  ReadMoleculeResult read = read_molecule(spec, options);
  return {record, std::move(read.molecule), std::move(read.decisions)};
}

}  // namespace

DockBody read_dock_body(const std::string& text, const ReadMoleculeOptions& options) {
  const MoleculeSpec spec = parse_molecule_spec(text);
  BodyRecord record;
  record.path = spec.path;
  record.spec = text;
  DockBody body = read_body(record, spec, options);
  body.record.sha256 = sha256_of_file(spec.path);
  return body;
}

DockBody read_recorded_body(const BodyRecord& record, const Provenance& provenance,
                            const std::string& name, const std::string& text,
                            const ReadMoleculeOptions& options) {
  LocateOptions where;
  if (!text.empty()) {
    const MoleculeSpec given = parse_molecule_spec(text);
    const MoleculeSpec recorded = recorded_spec(record, given.path);
    if (given.model != recorded.model || given.chains != recorded.chains)
      throw InputError("--resume: the run's " + name + " input is " + record.spec + ", got " +
                       text);
    where.path = given.path;
  }
  BodyRecord bare = record;
  bare.knots = {};
  return read_body(bare, recorded_spec(record, locate_input(record, provenance, name, where)),
                   options);
}

SearchResult dock(const DockBody& fixed, const DockBody& moving, const DockSettings& settings,
                  const Provenance& provenance, const SearchWatch& watch, const Run* earlier) {
  const auto begin = std::chrono::steady_clock::now();
  constexpr double kReach = 50.0;  // angstrom
  const RigidMotion start =
      settings.random_start ? random_start(*settings.random_start, kReach) : RigidMotion{};
  Molecule started = moving.molecule;
  for (Atom& atom : started.atoms) atom.position = start * atom.position;
  Docking docking(fixed.molecule, started, settings.options);
  return run_search(
      {"dock", fixed.record, moving.record, docking.fixed_knots(), docking.moving_knots(), start,
       &docking.rotations(), &docking.search(), [&] { return docking.rank(); }, begin},
      provenance, watch, earlier);
}

}  // namespace mortise::app
