// SPDX-License-Identifier: GPL-3.0-or-later
// The table of docking options, on the command line and in JSON.
#include "dock_options.hpp"

#include "mortise/core/errors.hpp"

namespace mortise::app {
namespace {

using Json = nlohmann::ordered_json;

template <class Value>
using Field = OptionField<DockOptions, Value>;

const Field<double> kReals[] = {
    {"spacing", "--spacing", "Grid step, angstrom",
     [](DockOptions& o) -> double& { return o.search.spacing; }},
    {"cutoff", "--cutoff", "Frequency where the low-pass reaches zero, cycles per angstrom",
     [](DockOptions& o) -> double& { return o.search.cutoff; }},
    {"separation", "--separation",
     "Least distance between translations kept at one rotation, angstrom",
     [](DockOptions& o) -> double& { return o.search.separation; }},
    {"offset", "--offset", "Thickness of the skin, angstrom",
     [](DockOptions& o) -> double& { return o.double_skin.offset; }},
    {"penalty", "--penalty", "What the core weighs against the skin",
     [](DockOptions& o) -> double& { return o.double_skin.penalty; }},
    {"radius", "--radius", "Radius of every heavy atom, angstrom",
     [](DockOptions& o) -> double& { return o.radius; }},
    {"propensity", "--propensity", "Strength of the residues' interface propensities",
     [](DockOptions& o) -> double& { return o.propensity; }},
    {"cluster_radius", "--cluster-radius",
     "Drop poses whose ligand RMSD to a better one is below this, angstrom; 0 = keep all",
     [](DockOptions& o) -> double& { return o.cluster_radius; }},
};

const Field<int> kIntegers[] = {
    {"rotations", "--rotations", "Rotations searched",
     [](DockOptions& o) -> int& { return o.rotations; }},
    {"per_rotation", "--per-rotation", "Best translations kept at each rotation",
     [](DockOptions& o) -> int& { return o.search.per_rotation; }},
    {"spread_width", "--spread-width", "Grid cells per axis that an atom is spread over, 2 to 8",
     [](DockOptions& o) -> int& { return o.search.spread_width; }},
    {"poses", "--poses", "Poses reported", [](DockOptions& o) -> int& { return o.poses; }},
};

const Field<std::string> kTexts[] = {
    {"potential", "--potential", "File of the contact potential; none = the fitted one",
     [](DockOptions& o) -> std::string& { return o.potential; }},
};

template <class Value>
void add_field(CLI::App& command, DockArguments& arguments, const Field<Value>& field) {
  add_option_field(command, arguments, dock_preset("default"), field);
}

}  // namespace

void add_dock_options(CLI::App& command, DockArguments& arguments) {
  command
      .add_option("--preset", arguments.preset,
                  "fast, default or thorough; the options below go over it and show the values of "
                  "default")
      ->default_str("default");
  add_field(command, arguments, kIntegers[0]);  // --rotations first
  for (const Field<double>& field : kReals) add_field(command, arguments, field);
  for (const Field<int>& field : kIntegers)
    if (&field != kIntegers) add_field(command, arguments, field);
  for (const Field<std::string>& field : kTexts) add_field(command, arguments, field);
  const auto add_switch = [&](const char* flag, const char* help, void (*set)(DockSettings&)) {
    command.add_flag_callback(
        flag, [&arguments, set] { arguments.overrides.emplace_back(set); }, help);
  };
  add_switch("--no-rescore", "Rank by shape alone",
             [](DockSettings& s) { s.options.rescore = false; });
  add_switch("--polish", "Refine kept poses", [](DockSettings& s) { s.options.polish = true; });
  add_switch("--no-polish", "Leave kept poses where the search found them",
             [](DockSettings& s) { s.options.polish = false; });
  add_switch("--no-ligands", "Leave cofactors and other hetero groups out",
             [](DockSettings& s) { s.read.keep_ligands = false; });
  add_switch("--no-ions", "Leave ions out", [](DockSettings& s) { s.read.keep_ions = false; });
}

DockSettings resolve(const DockArguments& arguments, const std::optional<DockSettings>& start) {
  DockSettings settings;
  if (start) settings = *start;
  if (arguments.preset || !start)
    settings.options = dock_preset(arguments.preset.value_or("default"));
  for (const auto& override_setting : arguments.overrides) override_setting(settings);
  return settings;
}

Json settings_json(const DockSettings& settings) {
  Json json = Json::parse(to_json(settings.options));
  json["ligands"] = settings.read.keep_ligands;
  json["ions"] = settings.read.keep_ions;
  json["random_start"] = settings.random_start ? Json(*settings.random_start) : Json();
  return json;
}

DockSettings parse_settings(const std::string& text) {
  DockSettings settings;
  Json json;
  try {
    json = Json::parse(text);
    for (const Field<double>& field : kReals)
      field.of(settings.options) = json.at(field.key).get<double>();
    for (const Field<int>& field : kIntegers)
      field.of(settings.options) = json.at(field.key).get<int>();
    for (const Field<std::string>& field : kTexts)
      field.of(settings.options) = json.at(field.key).get<std::string>();
    settings.options.rescore = json.at("rescore").get<bool>();
    settings.options.polish = json.at("polish").get<bool>();
    settings.read.keep_ligands = json.at("ligands").get<bool>();
    settings.read.keep_ions = json.at("ions").get<bool>();
    if (!json.at("random_start").is_null())
      settings.random_start = json["random_start"].get<std::uint64_t>();
  } catch (const nlohmann::json::exception& e) {
    throw InputError(std::string("the run's options are not those of this program: ") + e.what());
  }
  expect_same_settings(json, settings_json(settings), "this program");
  return settings;
}

}  // namespace mortise::app
