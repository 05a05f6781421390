// SPDX-License-Identifier: GPL-3.0-or-later
// mortise evaluate: measures a run's poses against the known complex.
#include <cstdio>
#include <memory>

#include "commands.hpp"
#include "evaluate_parts.hpp"
#include "mortise/core/errors.hpp"
#include "mortise/metrics/quality_summary.hpp"
#include "mortise/metrics/reference_complex.hpp"
#include "mortise/molecules/read_molecule.hpp"
#include "mortise/report/interface_columns.hpp"
#include "mortise/runs/quality_columns.hpp"
#include "mortise/store/atomic_file.hpp"
#include "mortise/store/body.hpp"
#include "mortise/store/inputs.hpp"
#include "pose_table.hpp"

namespace mortise::app {
namespace {

using Json = nlohmann::ordered_json;

struct EvaluateFlags {
  CommonOptions common;
  std::string run;
  std::string reference_fixed;
  std::string reference_moving;
  std::string reference_pose;
  std::string pair;
  std::string fixed_path;
  std::string moving_path;
  bool force = false;
  std::size_t interfaces = 0;  ///< best poses whose interface is described
};

std::string shown(const ComplexMetrics& m) {
  char text[160];
  std::snprintf(text, sizeof text, "i-RMSD %.2f A, L-RMSD %.2f A, fnat %.2f, DockQ %.3f, %s",
                m.interface_rmsd, m.ligand_rmsd, m.fnat, m.dockq,
                std::string(to_string(m.capri)).c_str());
  return text;
}

void print_match(const char* label, const ResidueMatch& match) {
  std::printf("%-12s %zu of the reference's %zu residues matched\n", label, match.pairs.size(),
              match.reference_residues);
}

void print_first(const char* label, const std::optional<int>& rank) {
  std::printf("  %-28s %s\n", label, rank ? std::to_string(*rank).c_str() : "none");
}

void print_summary(const Run& run, const ReferenceSummary& reference,
                   const ComplexMetrics& superposed, const QualitySummary& summary) {
  print_match("receptor", reference.fixed);
  print_match("ligand", reference.moving);
  std::printf("%-12s %zu residues, %zu of them matched; %zu contacts, %zu of them matched\n",
              "interface", reference.interface_residues, reference.interface_residues_matched,
              reference.native_contacts, reference.native_contacts_matched);
  std::printf("%-12s %s\n", "superposed", shown(superposed).c_str());
  std::printf("%-12s i-RMSD %.2f A, L-RMSD %.2f A, fnat %.2f, DockQ %.3f, each of any pose\n\n",
              "best", summary.best.interface_rmsd, summary.best.ligand_rmsd, summary.best.fnat,
              summary.best.dockq);
  std::printf("Rank of the first of %zu poses that is\n", run.poses.poses.size());
  print_first("acceptable or better", summary.first_acceptable);
  print_first("medium or better", summary.first_medium);
  print_first("high", summary.first_high);
  print_first("within 2.5 A i-RMSD", summary.first_hit);
  std::printf("\n%s", pose_table(run, 10).c_str());
}

Json to_json(const QualitySummary& summary) {
  const auto rank = [](const std::optional<int>& value) { return value ? Json(*value) : Json(); };
  return {{"first_acceptable", rank(summary.first_acceptable)},
          {"first_medium", rank(summary.first_medium)},
          {"first_high", rank(summary.first_high)},
          {"first_irmsd_2_5", rank(summary.first_hit)},
          {"first_within_2_percent", nullptr},  // of parts
          {"first_acceptable_by_rmsd", rank(summary.first_acceptable_by_rmsd)},
          {"best_interface_rmsd", summary.best.interface_rmsd},
          {"best_ligand_rmsd", summary.best.ligand_rmsd},
          {"best_fnat", summary.best.fnat},
          {"best_dockq", summary.best.dockq}};
}

// An option that does nothing for this kind of run is a misunderstanding.
void refuse_options(bool parts, const std::string& kind, const EvaluateFlags& options) {
  const std::pair<const char*, bool> given[] = {
      {"--reference-fixed", parts && !options.reference_fixed.empty()},
      {"--reference-moving", parts && !options.reference_moving.empty()},
      {"--fixed", parts && !options.fixed_path.empty()},
      {"--interface", parts && options.interfaces > 0},
      {"--reference-pose", !parts && !options.reference_pose.empty()},
      {"--pair", !parts && !options.pair.empty()}};
  for (const auto& [name, here] : given)
    if (here)
      throw InputError("evaluate: " + std::string(name) + " is for runs of " +
                       (parts ? "molecules" : "parts") + "; this is a " + kind + " run");
}

void execute(const EvaluateFlags& options) {
  Run run = read_run(options.run);
  if (!of_molecules(run)) {
    if (options.reference_pose.empty())
      throw InputError("evaluate: a run of parts needs --reference-pose");
    refuse_options(true, run.kind, options);
    evaluate_parts(options.run, options.reference_pose, options.pair,
                   {options.moving_path, options.force}, options.common);
    return;
  }
  if (options.reference_fixed.empty() || options.reference_moving.empty())
    throw InputError("evaluate: a docking needs --reference-fixed and --reference-moving");
  refuse_options(false, run.kind, options);
  if (run.poses.poses.empty()) throw InputError("evaluate: " + options.run + " holds no poses yet");
  check_writable(options.run);
  const auto molecule = [&](const BodyRecord& record, const char* name, const std::string& path) {
    return *read_input_body(record, run.provenance, name, {path, options.force}).molecule();
  };
  const Molecule fixed = molecule(run.fixed, "fixed", options.fixed_path);
  const Molecule moving = molecule(run.moving, "moving", options.moving_path);
  const ReferenceComplex reference(
      fixed, moving, read_molecule(parse_molecule_spec(options.reference_fixed)).molecule,
      read_molecule(parse_molecule_spec(options.reference_moving)).molecule);

  std::vector<RigidMotion> poses;
  for (const Pose& pose : run.poses.poses) poses.push_back(pose.moving_in_fixed);
  const std::vector<ComplexMetrics> metrics =
      evaluate_poses(reference, poses, options.common.threads);
  const ComplexMetrics superposed = reference.evaluate(reference.superposed_pose());
  set_quality_columns(run, metrics);
  if (options.interfaces > 0)
    set_metric_columns(
        run,
        interface_columns(MolecularInterface(fixed, moving, {.threads = options.common.threads}),
                          run.poses, options.interfaces, options.common.threads));
  write_run(options.run, run);

  const QualitySummary summary = summarise(metrics);
  if (options.common.json) {
    Json json = to_json(summary);
    json["poses"] = poses.size();
    json["superposed"] = {{"interface_rmsd", superposed.interface_rmsd},
                          {"ligand_rmsd", superposed.ligand_rmsd},
                          {"fnat", superposed.fnat},
                          {"dockq", superposed.dockq},
                          {"capri", to_string(superposed.capri)}};
    std::printf("%s\n", json.dump().c_str());
  } else if (!options.common.quiet) {
    print_summary(run, reference.summary(), superposed, summary);
  }
}

}  // namespace

void add_evaluate(CLI::App& program) {
  auto options = std::make_shared<EvaluateFlags>();
  CLI::App& command = *program.add_subcommand(
      "evaluate", "Measure a run's poses against the known answer, add the metrics to the run");
  command.add_option("run", options->run, "Run file; its metrics are added or replaced")
      ->required();
  command.add_option("--reference-fixed", options->reference_fixed,
                     "Receptor in the complex: FILE, or FILE#MODEL:CHAIN,CHAIN");
  command.add_option("--reference-moving", options->reference_moving,
                     "Ligand in the complex, likewise, in the same frame");
  command.add_option("--reference-pose,--mates", options->reference_pose,
                     "Parts: file of true placements, as parts/mates.json");
  command.add_option("--pair", options->pair,
                     "Parts: name of the pair in that file; default: by the parts' file names");
  command.add_option("--fixed", options->fixed_path,
                     "Where the receptor's file is now; of parts only the moving one is read");
  command.add_option("--moving", options->moving_path,
                     "Where the ligand's (moving part's) file is now");
  command.add_flag("--force", options->force, "Accept input files that have changed since the run");
  command.add_option(
      "--interface", options->interfaces,
      "Describe the interfaces of the best N poses of molecules too: buried area, contacts,\n"
      "hydrogen bonds, clashes, shape complementarity Sc");
  add_common_options(
      command, options->common,
      "  mortise evaluate run.h5 --reference-fixed complex.pdb:A --reference-moving complex.pdb:B\n"
      "  mortise evaluate run.h5 --reference-fixed rec_b.pdb --reference-moving lig_b.pdb --json\n"
      "  mortise evaluate mate.h5 --reference-pose parts/mates.json\n"
      "Classes are CAPRI's, from i-RMSD, L-RMSD and fnat. In the superposed pose each unbound\n"
      "body is laid on its own reference: the best that a rigid docking can reach. For parts\n"
      "the error is the surface's distance from its true place, largest and rms, over the\n"
      "part's diameter.");
  command.callback([options] { execute(*options); });
}

}  // namespace mortise::app
