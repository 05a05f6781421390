// SPDX-License-Identifier: GPL-3.0-or-later
// The table of mating options, on the command line and in JSON.
#include "mate_options.hpp"

#include <cstdio>

#include "mortise/core/errors.hpp"
#include "mortise/parts/read_part.hpp"

namespace mortise::app {
namespace {

using Json = nlohmann::ordered_json;

template <class Value>
using Field = OptionField<MateOptions, Value>;

const Field<double> kReals[] = {
    {"spacing", "--spacing", "Grid step of the search",
     [](MateOptions& o) -> double& { return o.spacing; }},
    {"most_cells", "--most-cells",
     "About the most grid cells searched; beyond it spacing and skin grow; not a length",
     [](MateOptions& o) -> double& { return o.most_cells; }},
    {"separation", "--separation", "Least distance between translations kept at one rotation",
     [](MateOptions& o) -> double& { return o.separation; }},
    {"skin", "--skin", "Thickness of the double skin",
     [](MateOptions& o) -> double& { return o.skin; }},
    {"penalty", "--penalty", "What the core weighs against the skin; not a length",
     [](MateOptions& o) -> double& { return o.penalty; }},
    {"feature", "--feature", "Emphasis on tips and hollows over flat faces, >= 0; not a length",
     [](MateOptions& o) -> double& { return o.feature; }},
    {"skeletal", "--skeletal",
     "Weight of the parts' skeletal densities as a second channel; not a length",
     [](MateOptions& o) -> double& { return o.skeletal; }},
    {"detail", "--detail", "Grid step of the parts' distances, for judging contact",
     [](MateOptions& o) -> double& { return o.detail; }},
    {"tolerance", "--tolerance", "Distance up to which surfaces count as in contact",
     [](MateOptions& o) -> double& { return o.tolerance; }},
    {"flat", "--flat",
     "What contact that pushes one way counts where other contact holds, 0 to 1; not a length",
     [](MateOptions& o) -> double& { return o.flat; }},
    {"overlap", "--overlap", "What penetration costs against contact; not a length",
     [](MateOptions& o) -> double& { return o.overlap; }},
    {"cluster_radius", "--cluster-radius",
     "Drop placements whose RMSD to a better one is below this; 0 = keep all",
     [](MateOptions& o) -> double& { return o.cluster_radius; }},
};

const Field<int> kIntegers[] = {
    {"rotations", "--rotations", "Rotations searched; with --axis turns for each way round",
     [](MateOptions& o) -> int& { return o.rotations; }},
    {"aligned", "--aligned", "Most rotations added that lay flat faces against each other",
     [](MateOptions& o) -> int& { return o.aligned; }},
    {"turns", "--turns", "Turns added about each pair of axes of turned faces",
     [](MateOptions& o) -> int& { return o.turns; }},
    {"per_rotation", "--per-rotation", "Best translations kept at each rotation",
     [](MateOptions& o) -> int& { return o.per_rotation; }},
    {"samples", "--samples", "Points on the smaller part's surface",
     [](MateOptions& o) -> int& { return o.samples; }},
    {"polished", "--polished", "Placements polished to the end",
     [](MateOptions& o) -> int& { return o.polished; }},
    {"poses", "--poses", "Poses reported", [](MateOptions& o) -> int& { return o.poses; }},
};

template <class Value>
void add_field(CLI::App& command, MateArguments& arguments, const Field<Value>& field) {
  add_option_field(command, arguments, mate_preset("default"), field);
}

MateAxis parse_axis(const std::string& text) {
  MateAxis axis;
  char rest = 0;
  const int read =
      std::sscanf(text.c_str(), "%lf,%lf,%lf:%lf,%lf,%lf%c", &axis.fixed[0], &axis.fixed[1],
                  &axis.fixed[2], &axis.moving[0], &axis.moving[1], &axis.moving[2], &rest);
  if (read != 6)
    throw InputError(
        "--axis: expected X,Y,Z:X,Y,Z (of the fixed part, of the moving part), got \"" + text +
        "\"");
  return axis;
}

Eigen::Vector3d vector_of(const Json& json) {
  const auto v = json.get<std::array<double, 3>>();
  return {v[0], v[1], v[2]};
}

}  // namespace

void add_mate_options(CLI::App& command, MateArguments& arguments) {
  command
      .add_option("--preset", arguments.preset,
                  "fast, default or thorough; the options below go over it and show the values of "
                  "default. Lengths are fractions of the smaller part's diameter")
      ->default_str("default");
  add_field(command, arguments, kIntegers[0]);  // --rotations first
  command
      .add_option_function<std::string>(
          "--axis",
          [&arguments](const std::string& text) {
            arguments.overrides.emplace_back(
                [axis = parse_axis(text)](MateSettings& s) { s.options.axis = axis; });
          },
          "Lay the moving part's axis along the fixed part's, either way round, and turn about it "
          "only: X,Y,Z:X,Y,Z in the parts' own frames")
      ->default_str("none");
  for (const Field<double>& field : kReals) add_field(command, arguments, field);
  for (const Field<int>& field : kIntegers)
    if (&field != kIntegers) add_field(command, arguments, field);
  command
      .add_option_function<double>(
          "--deviation",
          [&arguments](const double& value) {
            arguments.overrides.emplace_back([value](MateSettings& s) { s.deviation = value; });
          },
          "Deviation of a STEP file's tessellation, length unit; 0 = its diagonal times " +
              Json(ReadPartOptions{}.deviation).dump())
      ->default_str("0");
  command
      .add_option_function<int>(
          "--check",
          [&arguments](const int& value) {
            arguments.overrides.emplace_back([value](MateSettings& s) { s.checked = value; });
          },
          "Best poses whose contact is checked exactly")
      ->default_str(std::to_string(MateSettings{}.checked))
      ->check(CLI::NonNegativeNumber);
  command.add_flag_callback(
      "--allow-open",
      [&arguments] {
        arguments.overrides.emplace_back([](MateSettings& s) { s.allow_open = true; });
      },
      "Accept parts that cannot be closed; inside goes by the winding number");
}

MateSettings resolve(const MateArguments& arguments, const std::optional<MateSettings>& start) {
  MateSettings settings;
  if (start) settings = *start;
  if (arguments.preset || !start)
    settings.options = mate_preset(arguments.preset.value_or("default"));
  for (const auto& override_setting : arguments.overrides) override_setting(settings);
  return settings;
}

Json settings_json(const MateSettings& settings) {
  Json json = Json::parse(to_json(settings.options));
  json["deviation"] = settings.deviation;
  json["checked"] = settings.checked;
  json["allow_open"] = settings.allow_open;
  json["random_start"] = settings.random_start ? Json(*settings.random_start) : Json();
  return json;
}

MateSettings parse_mate_settings(const std::string& text) {
  MateSettings settings;
  Json json;
  try {
    json = Json::parse(text);
    for (const Field<double>& field : kReals)
      field.of(settings.options) = json.at(field.key).get<double>();
    for (const Field<int>& field : kIntegers)
      field.of(settings.options) = json.at(field.key).get<int>();
    if (!json.at("axis").is_null())
      settings.options.axis =
          MateAxis{vector_of(json["axis"].at("fixed")), vector_of(json["axis"].at("moving"))};
    settings.deviation = json.at("deviation").get<double>();
    settings.checked = json.at("checked").get<int>();
    settings.allow_open = json.at("allow_open").get<bool>();
    if (!json.at("random_start").is_null())
      settings.random_start = json["random_start"].get<std::uint64_t>();
  } catch (const nlohmann::json::exception& e) {
    throw InputError(std::string("the run's options are not those of this program: ") + e.what());
  }
  expect_same_settings(json, settings_json(settings), "this program");
  return settings;
}

}  // namespace mortise::app
