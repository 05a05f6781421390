// SPDX-License-Identifier: GPL-3.0-or-later
// mortise info: what a run, knots or structure file holds.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <numbers>

#include "clearances.hpp"
#include "commands.hpp"
#include "mortise/core/errors.hpp"
#include "mortise/molecules/read_molecule.hpp"
#include "mortise/parts/diameter.hpp"
#include "mortise/parts/read_part.hpp"
#include "mortise/store/balls_file.hpp"
#include "mortise/store/body.hpp"
#include "mortise/store/knots_file.hpp"
#include "mortise/store/run_file.hpp"

namespace mortise::app {
namespace {

using Json = nlohmann::ordered_json;

struct InfoFlags {
  CommonOptions common;
  std::string file;
};

constexpr std::size_t kPosesShown = 5;

Json figures_json(const std::vector<Figure>& figures) {
  Json result = Json::object();
  for (const Figure& figure : figures)
    if (!is_clearance_figure(figure)) result[figure.name] = figure.value;
  return result;
}

Json provenance_json(const Provenance& p) {
  const Json options = Json::parse(p.options_json, nullptr, false);
  return {{"mortise_version", p.mortise_version},
          {"command_line", p.command_line},
          {"working_directory", p.working_directory},
          {"options", options.is_discarded() ? Json(p.options_json) : options},
          {"seed", p.seed},
          {"utc_time", p.utc_time},
          {"host", p.host}};
}

Json knots_json(const Knots& knots) {
  Json result = {{"count", knots.size()}};
  if (knots.size() == 0) return result;
  const Eigen::Vector4d low = knots.points.rowwise().minCoeff();
  const Eigen::Vector4d high = knots.points.rowwise().maxCoeff();
  result["low"] = {low[0], low[1], low[2]};
  result["high"] = {high[0], high[1], high[2]};
  result["radii"] = {low[3], high[3]};
  return result;
}

Json body_json(const BodyRecord& body) {
  return {{"kind", body.kind},
          {"path", body.path},
          {"spec", body.spec},
          {"sha256", body.sha256},
          {"knots", knots_json(body.knots)}};
}

Json describe_run(const Run& run) {
  Json result = {{"type", "run"},
                 {"kind", run.kind},
                 {"complete", run.complete},
                 {"format_version", kRunFormatVersion},
                 {"provenance", provenance_json(run.provenance)},
                 {"seconds", run.seconds},
                 {"figures", figures_json(run.figures)},
                 {"fixed", body_json(run.fixed)},
                 {"moving", body_json(run.moving)}};
  result["rotations"] = {
      {"count", run.rotations.done.size()},
      {"done", std::count(run.rotations.done.begin(), run.rotations.done.end(), 1)},
      {"covering_radius_degrees", run.rotations.covering_radius * 180.0 / std::numbers::pi}};
  Json metrics = Json::array();
  for (const MetricColumn& metric : run.metrics) metrics.push_back(metric.name);
  Json best = Json::array();
  for (std::size_t i = 0; i < std::min(kPosesShown, run.poses.poses.size()); ++i) {
    const Pose& pose = run.poses.poses[i];
    const Eigen::Quaterniond& q = pose.moving_in_fixed.rotation;
    const Eigen::Vector3d& t = pose.moving_in_fixed.translation;
    best.push_back({{"rank", i + 1},
                    {"score", pose.score},
                    {"quaternion", {q.w(), q.x(), q.y(), q.z()}},
                    {"translation", {t.x(), t.y(), t.z()}},
                    {"cluster", pose.cluster}});
  }
  result["poses"] = {{"count", run.poses.poses.size()},
                     {"channels", run.poses.channel_names},
                     {"metrics", metrics},
                     {"best", best}};
  result["candidates"] = run.candidates.size();
  add_clearances(result, run);
  return result;
}

Json describe_knots_file(const KnotsFile& file) {
  return {{"type", "knots"},
          {"format_version", kKnotsFormatVersion},
          {"provenance", provenance_json(file.provenance)},
          {"figures", figures_json(file.figures)},
          {"source", {{"path", file.source_path}, {"sha256", file.source_sha256}}},
          {"knots", knots_json(file.knots)}};
}

Json describe_structure(const MoleculeSpec& spec) {
  ReadMoleculeResult read;
  try {
    read = read_molecule(spec, {.keep_hydrogens = true, .keep_waters = true});
  } catch (const InputError& e) {
    throw InputError(std::string(e.what()) +
                     " (info reads run and knots files, meshes, STEP, .xyzr, PDB and mmCIF)");
  }
  const std::vector<Atom>& atoms = read.molecule.atoms;
  struct Chain {
    std::string name;
    std::size_t residues = 0, hetero = 0, atoms = 0;
  };
  std::vector<Chain> chains;
  for (const ResidueRange& residue : residues(read.molecule)) {
    const Atom& first = atoms[residue.first];
    auto chain = std::find_if(chains.begin(), chains.end(),
                              [&](const Chain& c) { return c.name == first.chain; });
    if (chain == chains.end()) chain = chains.insert(chain, Chain{first.chain});
    (first.hetero ? chain->hetero : chain->residues) += 1;
    chain->atoms += residue.last - residue.first;
  }
  Eigen::Vector3d low = atoms.front().position, high = low;
  for (const Atom& atom : atoms) {
    low = low.cwiseMin(atom.position);
    high = high.cwiseMax(atom.position);
  }
  Json list = Json::array();
  for (const Chain& chain : chains)
    list.push_back({{"chain", chain.name},
                    {"residues", chain.residues},
                    {"hetero_groups", chain.hetero},
                    {"atoms", chain.atoms}});
  return {{"type", "structure"},
          {"atoms", atoms.size()},
          {"chains", list},
          {"low", {low[0], low[1], low[2]}},
          {"high", {high[0], high[1], high[2]}},
          {"decisions", read.decisions}};
}

Json describe_part(const std::string& path) {
  std::string refusal;
  const ReadPartResult part = [&] {
    try {
      return read_part(path);
    } catch (
        const FileError& error) {  // what others refuse is shown, if it can be, with the reason
      refusal = error.what();
      try {
        return read_part(path, {.repair = {.allow_open = true}});
      } catch (const FileError&) {
        throw error;
      }
    }
  }();
  const Eigen::Vector3d low = part.mesh.vertices.rowwise().minCoeff();
  const Eigen::Vector3d high = part.mesh.vertices.rowwise().maxCoeff();
  return {{"type", "part"},
          {"triangles", part.mesh.size()},
          {"vertices", part.mesh.vertices.cols()},
          {"closed", part.closed},
          {"volume", part.volume},
          {"unit", part.unit},
          {"diameter", diameter_of(part.mesh.vertices)},
          {"low", {low[0], low[1], low[2]}},
          {"high", {high[0], high[1], high[2]}},
          {"refused", refusal},
          {"decisions", part.decisions}};
}

Json describe(const std::string& file) {
  const MoleculeSpec spec = parse_molecule_spec(file);
  switch (stored_kind(spec.path)) {
    case StoredKind::kRun:
      return describe_run(read_run(spec.path));
    case StoredKind::kKnots:
      return describe_knots_file(read_knots_file(spec.path));
    case StoredKind::kOtherHdf5:
      throw FileError(spec.path,
                      "an HDF5 file, but not one of Mortise's: expected a run or knots file");
    case StoredKind::kNotHdf5:
      break;
  }
  if (body_kind(file) == BodyKind::kBalls)
    return {{"type", "balls"}, {"knots", knots_json(read_balls(spec.path))}};
  if (body_kind(file) == BodyKind::kPart) return describe_part(spec.path);
  return describe_structure(spec);
}

void line(const char* label, const std::string& text) {
  std::printf("  %-12s %s\n", label, text.c_str());
}

std::string number(const Json& value, const char* format = "%.6g") {
  char text[64];
  std::snprintf(text, sizeof text, format, value.get<double>());
  return text;
}

std::string vector_text(const Json& values, const char* format) {
  std::string text;
  for (const Json& value : values) text += (text.empty() ? "" : " ") + number(value, format);
  return text;
}

std::string names_text(const Json& names) {
  std::string text;
  for (const Json& name : names) text += (text.empty() ? "" : ", ") + name.get<std::string>();
  return text.empty() ? "none" : text;
}

std::string knots_text(const Json& knots) {
  if (knots["count"] == 0) return "0 knots";
  return knots["count"].dump() + " knots, radii " + number(knots["radii"][0], "%.3f") + " to " +
         number(knots["radii"][1], "%.3f") + ", box " + vector_text(knots["low"], "%.1f") + " to " +
         vector_text(knots["high"], "%.1f");
}

void print_provenance(const Json& all) {
  const Json& p = all["provenance"];
  line("made by", "mortise " + p["mortise_version"].get<std::string>() + ", " +
                      p["utc_time"].get<std::string>() + ", on " + p["host"].get<std::string>());
  line("command", p["command_line"]);
  line("directory", p["working_directory"]);
  line("options", p["options"].dump());
  line("seed", p["seed"].dump());
  for (const auto& [name, value] : all["figures"].items()) line(name.c_str(), number(value));
}

void print_source(const char* label, const Json& source) {
  const std::string sum = source["sha256"];
  line(label, source.value("spec", source["path"].get<std::string>()));
  line("", "SHA-256 " + (sum.empty() ? "not recorded" : sum));
}

void print_run(const std::string& file, const Json& all) {
  std::printf("%s: %s run, %s\n", file.c_str(), all["kind"].get<std::string>().c_str(),
              all["complete"].get<bool>() ? "complete" : "not finished (--resume finishes it)");
  print_provenance(all);
  line("seconds", number(all["seconds"], "%.2f"));
  for (const char* body : {"fixed", "moving"}) {
    print_source(body, all[body]);
    line("", knots_text(all[body]["knots"]));
  }
  const Json& rotations = all["rotations"];
  line("rotations", rotations["done"].dump() + " of " + rotations["count"].dump() +
                        " done, covering radius " +
                        number(rotations["covering_radius_degrees"], "%.2f") + " degrees");
  line("searched", all["candidates"].dump() + " candidates, kept to rank anew (mortise rescore)");
  const Json& poses = all["poses"];
  line("poses", poses["count"].dump());
  line("channels", names_text(poses["channels"]));
  line("metrics", names_text(poses["metrics"]));
  if (all.contains("clearances")) {
    line("clearance", number(all["best_clearance"]) + " fits best; best score by clearance:");
    for (const Json& one : all["clearances"])
      line("", number(one["clearance"], "%8.6g") + " " + number(one["best_score"], "%12.4f"));
  }
  if (poses["best"].empty()) return;
  std::printf("\n  %4s %12s  %-35s %-29s %s\n", "rank", "score", "quaternion w x y z",
              "translation x y z", "cluster");
  for (const Json& pose : poses["best"])
    std::printf("  %4d %12.4f  %-35s %-29s %d\n", pose["rank"].get<int>(),
                pose["score"].get<double>(), vector_text(pose["quaternion"], "%8.5f").c_str(),
                vector_text(pose["translation"], "%9.3f").c_str(), pose["cluster"].get<int>());
}

void print_knots(const std::string& file, const Json& all) {
  std::printf("%s: knots file\n", file.c_str());
  print_provenance(all);
  print_source("source", all["source"]);
  line("knots", knots_text(all["knots"]));
}

void print_structure(const std::string& file, const Json& all) {
  std::printf("%s: structure, %zu atoms in %zu chains\n", file.c_str(),
              all["atoms"].get<std::size_t>(), all["chains"].size());
  line("box",
       vector_text(all["low"], "%.1f") + " to " + vector_text(all["high"], "%.1f") + " angstrom");
  for (const Json& decision : all["decisions"]) line("note", decision);
  std::printf("\n  %5s %9s %14s %9s\n", "chain", "residues", "hetero groups", "atoms");
  for (const Json& chain : all["chains"]) {
    const std::string name = chain["chain"];
    std::printf("  %5s %9zu %14zu %9zu\n", name.empty() ? "-" : name.c_str(),
                chain["residues"].get<std::size_t>(), chain["hetero_groups"].get<std::size_t>(),
                chain["atoms"].get<std::size_t>());
  }
}

void print_balls(const std::string& file, const Json& all) {
  std::printf("%s: balls\n", file.c_str());
  line("balls", knots_text(all["knots"]));
}

void print_part(const std::string& file, const Json& all) {
  std::printf("%s: part, %s\n", file.c_str(),
              all["closed"].get<bool>() ? "closed" : "open: inside goes by the winding number");
  const std::string unit = all["unit"];
  line("surface", all["triangles"].dump() + " triangles, " + all["vertices"].dump() + " vertices");
  line("unit", unit.empty() ? "not in the file" : unit);
  line("box", vector_text(all["low"], "%.6g") + " to " + vector_text(all["high"], "%.6g"));
  line("diameter", number(all["diameter"]));
  if (all["volume"].get<double>() > 0.0) line("volume", number(all["volume"]));
  for (const Json& decision : all["decisions"]) line("note", decision);
  if (const std::string why = all["refused"]; !why.empty()) line("refused", why);
}

void execute(const InfoFlags& options) {
  const Json all = describe(options.file);
  if (options.common.json) {
    std::printf("%s\n", all.dump(-1, ' ', false, Json::error_handler_t::replace).c_str());
    return;
  }
  if (options.common.quiet) return;
  const std::string type = all["type"];
  const auto print = type == "run"     ? print_run
                     : type == "knots" ? print_knots
                     : type == "balls" ? print_balls
                     : type == "part"  ? print_part
                                       : print_structure;
  print(options.file, all);
}

}  // namespace

void add_info(CLI::App& program) {
  auto options = std::make_shared<InfoFlags>();
  CLI::App& command = *program.add_subcommand(
      "info", "Show what a file holds: a run, a body taken apart, a molecule, a part, balls");
  command
      .add_option("file", options->file,
                  "Run or knots file, mesh, STEP, .xyzr, or structure with model and chains")
      ->required();
  add_common_options(command, options->common,
                     "  mortise info run.h5\n"
                     "  mortise info complex.pdb:A,B\n"
                     "  mortise info bracket.step\n"
                     "  mortise info run.h5 --json");
  command.callback([options] { execute(*options); });
}

}  // namespace mortise::app
