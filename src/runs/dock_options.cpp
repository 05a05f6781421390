// SPDX-License-Identifier: GPL-3.0-or-later
// The table of docking options and its presets.
#include "mortise/core/errors.hpp"
#include "mortise/runs/dock.hpp"
#include "runs/option_table.hpp"
#include "runs/seed_option.hpp"

namespace mortise {
namespace {

using Row = OptionRow<DockOptions>;
using O = DockOptions;
constexpr auto kReading = OptionScope::kReading;
constexpr auto kSearch = OptionScope::kSearch;
constexpr auto kRanking = OptionScope::kRanking;

std::string print_lift(const O& o) {
  return o.search.lift == SearchLift::k4d ? "4d" : "compressed";
}

void parse_lift(O& o, const std::string& text) {
  if (text != "compressed" && text != "4d")
    throw InputError("lift: expected compressed or 4d, got \"" + text + '"');
  o.search.lift = text == "4d" ? SearchLift::k4d : SearchLift::kCompressed;
}

constexpr Row kRows[] = {
    {"rotations", kSearch, "Rotations searched",
     Row::Integer([](O& o) -> int& { return o.rotations; }), 1.0},
    {"spacing", kSearch, "Grid step, angstrom",
     Row::Real([](O& o) -> double& { return o.search.spacing; }), 0.0, 1e3, true},
    {"cutoff", kSearch, "Frequency where the low-pass reaches zero, cycles per angstrom",
     Row::Real([](O& o) -> double& { return o.search.cutoff; }), 0.0, 1e3, true},
    {"per_rotation", kSearch, "Translations kept at each rotation, the best",
     Row::Integer([](O& o) -> int& { return o.search.per_rotation; }), 1.0, 1000.0},
    {"separation", kSearch, "Least distance between translations kept at one rotation, angstrom",
     Row::Real([](O& o) -> double& { return o.search.separation; }), 0.0, 1e4},
    {"spread_width", kSearch, "Grid cells per axis that an atom is spread over",
     Row::Integer([](O& o) -> int& { return o.search.spread_width; }), 2.0, 8.0},
    {"offset", kSearch, "Thickness of the skin, angstrom",
     Row::Real([](O& o) -> double& { return o.double_skin.offset; }), 0.0, 100.0, true},
    {"penalty", kSearch, "Weight of core overlap against skin contact",
     Row::Real([](O& o) -> double& { return o.double_skin.penalty; }), 0.0, 1e6},
    {"penalty_radius", kSearch,
     "Radius at which the penalty holds, angstrom; at others core and skin keep the ratio of their "
     "volumes; 0 = one penalty for all",
     Row::Real([](O& o) -> double& { return o.double_skin.penalty_radius; }), 0.0, 1e6},
    {"radius", kSearch, "Radius of every heavy atom, angstrom; 0 = by its type (united atoms)",
     Row::Real([](O& o) -> double& { return o.radius; }), 0.0, 100.0},
    {"merge_buried", kSearch,
     "Merge buried atoms into balls up to this radius, angstrom; 0 = one ball per atom",
     Row::Real([](O& o) -> double& { return o.merge_buried; }), 0.0, 100.0},
    {"propensity", kSearch, "Strength of the residues' interface propensities",
     Row::Real([](O& o) -> double& { return o.propensity; }), 0.0, 2.0},
    {"ball_grid", kSearch,
     "Of a mesh or STEP body: grid nodes along its longest side when it is made into balls",
     Row::Integer([](O& o) -> int& { return o.ball_grid; }), 2.0, 1024.0},
    {"rescore", kRanking, "Rank by shape and contact potential, not by shape alone",
     Row::Switch([](O& o) -> bool& { return o.rescore; })},
    {"potential", kRanking, "File of the contact potential; none = the fitted one",
     Row::Text([](O& o) -> std::string& { return o.potential; })},
    {"polish", kRanking, "Move the best poses uphill on their score",
     Row::Switch([](O& o) -> bool& { return o.polish; })},
    {"poses", kRanking, "Poses reported", Row::Integer([](O& o) -> int& { return o.poses; }), 1.0},
    {"cluster_radius", kRanking,
     "Drop poses whose ligand RMSD to a better one is below this, angstrom; 0 = keep all",
     Row::Real([](O& o) -> double& { return o.cluster_radius; }), 0.0, 1e4},
    {"described", kRanking,
     "Best poses whose shape score's truncation error and sensitivity to the radii are given",
     Row::Integer([](O& o) -> int& { return o.described; }), 0.0},
    {"radius_tolerance", kSearch,
     "Error allowed of a ball's transform where radii differ, relative to its largest value",
     Row::Real([](O& o) -> double& { return o.search.radius_tolerance; }), 1e-8, 0.1},
    {"lift", kSearch,
     "How fields of unequal radii are summed: compressed, or 4d for the exact four-dimensional "
     "sum, some twenty times slower",
     TextForm<O>{print_lift, parse_lift}},
    {"ligands", kReading, "Keep cofactors and other hetero groups",
     Row::Switch([](O& o) -> bool& { return o.read.keep_ligands; })},
    {"ions", kReading, "Keep ions", Row::Switch([](O& o) -> bool& { return o.read.keep_ions; })},
    {"random_start", kReading,
     "Seed of a random motion of the ligand before the search, for tests on known complexes; "
     "none = no motion",
     seed_form<O>()},
};

}  // namespace

std::span<const OptionRow<DockOptions>> dock_option_rows() { return kRows; }

DockOptions dock_preset(const std::string& name) {
  DockOptions options;
  if (name == "default") return options;
  if (name == "fast") {
    options.search.spacing = 3.5;
    options.search.per_rotation = 2;
    return options;
  }
  if (name == "thorough") {
    options.rotations = 54000;
    options.search.per_rotation = 2;
    return options;
  }
  throw InputError("preset '" + name + "' is not one of fast, default, thorough");
}

std::string to_json(const DockOptions& options) {
  return options_json(dock_option_rows(), options).dump();
}

DockOptions parse_dock_options(const std::string& json) {
  return parse_options(dock_option_rows(), json);
}

}  // namespace mortise
