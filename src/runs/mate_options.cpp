// SPDX-License-Identifier: GPL-3.0-or-later
// The table of mating options and its presets.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <utility>

#include "mortise/core/errors.hpp"
#include "mortise/runs/mate.hpp"
#include "runs/option_table.hpp"
#include "runs/seed_option.hpp"

namespace mortise {
namespace {

using Row = OptionRow<MateOptions>;
using O = MateOptions;
constexpr auto kReading = OptionScope::kReading;
constexpr auto kSearch = OptionScope::kSearch;
constexpr auto kRanking = OptionScope::kRanking;

std::string print_axis(const O& o) {
  if (!o.axis) return "none";
  const auto vector = [](const Eigen::Vector3d& v) {
    return short_number(v[0]) + "," + short_number(v[1]) + "," + short_number(v[2]);
  };
  return vector(o.axis->fixed) + ":" + vector(o.axis->moving);
}

void parse_axis(O& o, const std::string& text) {
  o.axis.reset();
  if (text == "none") return;
  MateAxis axis;
  char rest = 0;
  const int read =
      std::sscanf(text.c_str(), "%lf,%lf,%lf:%lf,%lf,%lf%c", &axis.fixed[0], &axis.fixed[1],
                  &axis.fixed[2], &axis.moving[0], &axis.moving[1], &axis.moving[2], &rest);
  if (read != 6)
    throw InputError("axis: expected X,Y,Z:X,Y,Z (of the fixed part, of the moving part), got \"" +
                     text + "\"");
  o.axis = axis;
}

constexpr std::pair<PartKnots, const char*> kForms[] = {{PartKnots::kNodes, "nodes"},
                                                        {PartKnots::kBalls, "balls"}};

std::string print_form(const O& o) {
  for (const auto& [form, name] : kForms)
    if (form == o.knots) return name;
  return "";
}

void parse_form(O& o, const std::string& text) {
  for (const auto& [form, name] : kForms) {
    if (text != name) continue;
    o.knots = form;
    return;
  }
  throw InputError("knots: expected nodes or balls, got \"" + text + "\"");
}

std::string print_clearances(const O& o) {
  std::string text;
  for (const double c : o.clearances) text += (text.empty() ? "" : ",") + short_number(c);
  return text.empty() ? "none" : text;
}

// The numbers of a text, between them one kind of sign; empty if it is anything else.
std::vector<double> numbers_of(const std::string& text, char between) {
  std::vector<double> numbers;
  for (const char* at = text.c_str();; ++at) {
    char* end = nullptr;
    numbers.push_back(std::strtod(at, &end));
    if (end == at || !std::isfinite(numbers.back()) || (*end != between && *end != '\0')) return {};
    if (*end == '\0') return numbers;
    at = end;
  }
}

// MIN:STEP:MAX, both ends included, or a list in any order.
void parse_clearances(O& o, const std::string& text) {
  o.clearances.clear();
  if (text == "none") return;
  const auto refuse = [&](const std::string& why) {
    throw InputError("clearances: expected MIN:STEP:MAX or a list A,B,..., " + why + ", got \"" +
                     text + '"');
  };
  if (text.find(':') == std::string::npos) {
    o.clearances = numbers_of(text, ',');
    if (o.clearances.empty()) refuse("all of them numbers");
    std::sort(o.clearances.begin(), o.clearances.end());
    if (std::adjacent_find(o.clearances.begin(), o.clearances.end()) != o.clearances.end())
      refuse("each number once");
  } else {
    const std::vector<double> range = numbers_of(text, ':');
    if (range.size() != 3 || !(range[1] > 0.0) || !(range[2] >= range[0]))
      refuse("STEP > 0 and MAX >= MIN");
    const double steps = std::floor((range[2] - range[0]) / range[1] * (1.0 + 1e-12) + 1e-9);
    if (!(steps < kMostClearances))
      refuse("at most " + std::to_string(kMostClearances) + " clearances");
    for (int i = 0; i <= static_cast<int>(steps); ++i) {
      char decimal[40];  // 0.3, not the 0.30000000000000004 that 0.1 * 3 is
      std::snprintf(decimal, sizeof decimal, "%.12g", range[0] + i * range[1]);
      o.clearances.push_back(std::strtod(decimal, nullptr));
    }
  }
  if (o.clearances.front() < 0.0) refuse("none below 0");
  if (o.clearances.size() > kMostClearances)
    refuse("at most " + std::to_string(kMostClearances) + " clearances");
}

constexpr Row kRows[] = {
    {"rotations", kSearch, "Rotations searched; with --axis, turns for each way round",
     Row::Integer([](O& o) -> int& { return o.rotations; }), 1.0},
    {"axis", kSearch,
     "Turn about one axis only, the moving part's laid along the fixed part's, either way round: "
     "X,Y,Z:X,Y,Z in the parts' own frames",
     TextForm<O>{print_axis, parse_axis}},
    {"aligned", kSearch, "Rotations added, at most, that lay flat faces against each other",
     Row::Integer([](O& o) -> int& { return o.aligned; }), 0.0},
    {"turns", kSearch, "Turns added about each pair of axes of round faces laid along each other",
     Row::Integer([](O& o) -> int& { return o.turns; }), 0.0},
    {"spacing", kSearch, "Grid step of the search",
     Row::Real([](O& o) -> double& { return o.spacing; }), 0.0, 10.0, true},
    {"most_cells", kSearch,
     "Grid cells searched, at most, about; where more are needed spacing and skin grow; a count",
     Row::Real([](O& o) -> double& { return o.most_cells; }), 0.0, 1e9, true},
    {"per_rotation", kSearch, "Translations kept at each rotation, the best",
     Row::Integer([](O& o) -> int& { return o.per_rotation; }), 1.0, 1000.0},
    {"separation", kSearch, "Least distance between translations kept at one rotation",
     Row::Real([](O& o) -> double& { return o.separation; }), 0.0, 10.0},
    {"skin", kSearch, "Thickness of the double skin",
     Row::Real([](O& o) -> double& { return o.skin; }), 0.0, 10.0, true},
    {"penalty", kSearch, "Weight of core overlap against skin contact; a number",
     Row::Real([](O& o) -> double& { return o.penalty; }), 1.0, 1e6, true},
    {"feature", kSearch, "Emphasis on tips and hollows over flat faces; a number",
     Row::Real([](O& o) -> double& { return o.feature; }), 0.0, 100.0},
    {"skeletal", kSearch, "Weight of the skeletal densities as a second channel; a number",
     Row::Real([](O& o) -> double& { return o.skeletal; }), 0.0, 1e6},
    {"knots", kSearch,
     "What the search scores: nodes = the double skin on a grid, balls = the parts taken apart "
     "into "
     "balls",
     TextForm<O>{print_form, parse_form}},
    {"clearances", kSearch,
     "Gaps between facing surfaces to search for at once, on each side, in the files' length unit: "
     "MIN:STEP:MAX, or a list A,B,...; says which fits best. Needs --knots balls; none = parts "
     "that "
     "touch",
     TextForm<O>{print_clearances, parse_clearances}},
    {"ball_step", kSearch, "Grid step of the decomposition into balls",
     Row::Real([](O& o) -> double& { return o.ball_step; }), 0.0, 1.0, true},
    {"ball_mu", kSearch,
     "How far a ball may stick out of a chosen one, in its radii, and be passed over; not a length",
     Row::Real([](O& o) -> double& { return o.ball_mu; }), 0.0, 1.0},
    {"ball_largest", kSearch, "Radius of a ball, at most",
     Row::Real([](O& o) -> double& { return o.ball_largest; }), 0.0, 1e3, true},
    {"ball_penalty", kSearch,
     "What a ball's core weighs against the ball with its skin, by volume; not a length",
     Row::Real([](O& o) -> double& { return o.ball_penalty; }), 0.0, 1e6, true},
    {"ball_expansion", kSearch, "How much balls grow, in half grid cell diagonals; not a length",
     Row::Real([](O& o) -> double& { return o.ball_expansion; }), 0.0, 1.0},
    {"distance_spacing", kRanking, "Grid step of the parts' distances, for judging contact",
     Row::Real([](O& o) -> double& { return o.distance_spacing; }), 0.0, 10.0, true},
    {"tolerance", kRanking, "Distance up to which surfaces count as in contact",
     Row::Real([](O& o) -> double& { return o.tolerance; }), 0.0, 10.0, true},
    {"one_sided_weight", kRanking,
     "Weight of contact that pushes one way, as far as contact that holds backs it; a number",
     Row::Real([](O& o) -> double& { return o.one_sided_weight; }), 0.0, 1.0},
    {"penetration_weight", kRanking,
     "Cost of a penetrating area against an area of contact; a number",
     Row::Real([](O& o) -> double& { return o.penetration_weight; }), 0.0, 1e6},
    {"samples", kRanking, "Points on the smaller part's surface",
     Row::Integer([](O& o) -> int& { return o.samples; }), 100.0, 1e7},
    {"polished", kRanking, "Placements polished to the end",
     Row::Integer([](O& o) -> int& { return o.polished; }), 1.0, 1e6},
    {"poses", kRanking, "Poses reported", Row::Integer([](O& o) -> int& { return o.poses; }), 1.0},
    {"cluster_radius", kRanking,
     "Drop placements whose RMSD to a better one is below this; 0 = keep all",
     Row::Real([](O& o) -> double& { return o.cluster_radius; }), 0.0, 10.0},
    {"check", kRanking, "Best poses whose contact is measured exactly",
     Row::Integer([](O& o) -> int& { return o.check; }), 0.0},
    {"deviation", kReading,
     "Deviation of a STEP file's triangles from its surface, length unit of the file; 0 = its "
     "diagonal times 0.0005",
     Row::Real([](O& o) -> double& { return o.deviation; }), 0.0},
    {"allow_open", kReading,
     "Accept surfaces that cannot be closed; inside is where they wind around a point",
     Row::Switch([](O& o) -> bool& { return o.allow_open; })},
    {"random_start", kReading,
     "Seed of a random motion of the moving part before the search, for tests on parts that sit "
     "right; none = no motion",
     seed_form<O>()},
};

}  // namespace

std::span<const OptionRow<MateOptions>> mate_option_rows() { return kRows; }

MateOptions mate_preset(const std::string& name) {
  MateOptions options;
  if (name == "default") return options;
  if (name == "fast") {
    options.rotations = 60;
    return options;
  }
  if (name == "thorough") {
    options.rotations = 3600;
    options.polished = 200;
    return options;
  }
  throw InputError("preset '" + name + "' is not one of fast, default, thorough");
}

std::string to_json(const MateOptions& options) {
  return options_json(mate_option_rows(), options).dump();
}

MateOptions parse_mate_options(const std::string& json) {
  return parse_options(mate_option_rows(), json);
}

}  // namespace mortise
