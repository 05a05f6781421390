// SPDX-License-Identifier: GPL-3.0-or-later
// One known complex, docked and measured.
#include "mortise/runs/benchmark.hpp"

#include <chrono>
#include <cstdio>

#include "mortise/core/errors.hpp"
#include "mortise/metrics/quality_summary.hpp"
#include "mortise/metrics/reference_complex.hpp"
#include "mortise/molecules/read_molecule.hpp"
#include "mortise/runs/quality_columns.hpp"
#include "mortise/runs/run_kind.hpp"

namespace mortise {
namespace {

std::string text_of(double value) {
  char text[64];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

std::string text_of(const std::optional<int>& rank) { return rank ? std::to_string(*rank) : ""; }

// A start of its own for every pair: FNV-1a of the name, mixed with the seed.
std::uint64_t pair_seed(std::uint64_t seed, const std::string& name) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const char c : name + ":" + std::to_string(seed))
    hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
  return hash;
}

Body read_molecule_body(const std::string& spec, const ReadBodyOptions& reading) {
  Body body = read_body(spec, reading);
  if (body.molecule() == nullptr)
    throw InputError(spec + ": expected a molecule, found " + body.record.kind);
  return body;
}

void measure(const ReferenceComplex& reference, int threads, BenchmarkResult& result) {
  std::vector<RigidMotion> poses;
  for (const Pose& pose : result.run.poses.poses) poses.push_back(pose.moving_in_fixed);
  const std::vector<ComplexMetrics> metrics = evaluate_poses(reference, poses, threads);
  set_quality_columns(result.run, metrics);
  const QualitySummary summary = summarise(metrics);
  ResultRow& row = result.row;
  row["first_acceptable"] = text_of(summary.first_acceptable);
  row["first_acceptable_by_rmsd"] = text_of(summary.first_acceptable_by_rmsd);
  row["first_irmsd_2_5"] = text_of(summary.first_hit);
  row["first_medium"] = text_of(summary.first_medium);
  row["first_high"] = text_of(summary.first_high);
  row["best_interface_rmsd"] = text_of(summary.best.interface_rmsd);
  row["best_ligand_rmsd"] = text_of(summary.best.ligand_rmsd);
  row["best_fnat"] = text_of(summary.best.fnat);
  row["best_dockq"] = text_of(summary.best.dockq);
  row["superposed_interface_rmsd"] =
      text_of(reference.evaluate(reference.superposed_pose()).interface_rmsd);
}

}  // namespace

ResultRow result_row(const BenchmarkPair& pair) {
  ResultRow row;
  row["name"] = pair.name;
  row["difficulty"] = difficulty(pair.unbound_interface_rmsd);
  row["unbound_interface_rmsd"] = text_of(pair.unbound_interface_rmsd);
  return row;
}

BenchmarkResult dock_known_pair(const BenchmarkPair& pair, DockOptions docking, std::uint64_t seed,
                                const std::string& command_line, const RunWatch& watch) {
  const auto begin = std::chrono::steady_clock::now();
  docking.random_start = pair_seed(seed, pair.name);
  const ReadBodyOptions reading = dock_kind().reading(docking);
  const Body fixed = read_molecule_body(pair.fixed, reading);
  const Body moving = read_molecule_body(pair.moving, reading);
  BenchmarkResult result{
      run_plan(plan_dock(fixed, moving, docking),
               make_provenance(command_line, to_json(docking), *docking.random_start), watch),
      result_row(pair)};
  if (!result.run.complete) return result;
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
  result.run.seconds = spent.count();
  const auto reference = [](const std::string& spec) {
    return read_molecule(parse_molecule_spec(spec)).molecule;
  };
  measure(ReferenceComplex(*fixed.molecule(), *moving.molecule(), reference(pair.reference_fixed),
                           reference(pair.reference_moving)),
          docking.threads, result);
  result.row["rotations"] = std::to_string(result.run.rotations.done.size());
  result.row["poses"] = std::to_string(result.run.poses.poses.size());
  result.row["seconds"] = text_of(result.run.seconds);
  return result;
}

}  // namespace mortise
