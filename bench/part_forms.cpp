// SPDX-License-Identifier: GPL-3.0-or-later
// Ranking and cost of mating by forms of the parts' knots: grid nodes, balls.
//
// Mates the sample pairs from a random start with each form and prints a CSV row per pair and form:
// knots of both bodies, CPU seconds of set-up (distances, decomposition), search and ranking, the
// rank of the first pose within 2% of the moving part's diameter (0 = none) and its largest error
// in percent.
//
// Usage: part_forms PARTS_FOLDER SEED FIRST STEP FORM...
//   FIRST, STEP  pairs FIRST, FIRST + STEP, ... of mates.json, from 0
//   FORM         name:knots:ball_step:ball_mu:ball_largest:ball_penalty:ball_expansion
#include <array>
#include <cstdint>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench.hpp"
#include "mortise/core/errors.hpp"
#include "mortise/metrics/placement.hpp"
#include "mortise/metrics/true_mates.hpp"
#include "mortise/runs/mate.hpp"

namespace mortise {
namespace {

using bench::cpu_seconds;
using bench::split;

constexpr int kPoses = 20;
constexpr double kFound = 0.02;

struct Form {
  std::string name;
  MateOptions options;
};

// The options of a form, by the names they have in a run file.
Form parse_form(const std::string& text) {
  constexpr std::array<const char*, 6> kNames = {"knots",        "ball_step",    "ball_mu",
                                                 "ball_largest", "ball_penalty", "ball_expansion"};
  const std::vector<std::string> fields = split(text, ':');
  if (fields.size() != kNames.size() + 1)
    throw InputError("expected name:knots:step:mu:largest:penalty:expansion, found " + text);
  MateOptions defaults;
  defaults.poses = kPoses;
  nlohmann::json options = nlohmann::json::parse(to_json(defaults));
  options[kNames[0]] = fields[1];
  for (std::size_t i = 1; i < kNames.size(); ++i) options[kNames[i]] = std::stod(fields[i + 1]);
  Form form{fields[0], parse_mate_options(options.dump())};
  form.options.threads = 1;
  return form;
}

void run_pair(const std::string& folder, const TrueMate& truth, std::uint64_t seed,
              const std::vector<Form>& forms) {
  const Body fixed = read_body(folder + "/" + truth.fixed + ".stl");
  const Body moving = read_body(folder + "/" + truth.moving + ".stl");
  const Placement placement(moving.part()->mesh, truth);
  for (Form form : forms) {
    form.options.random_start = seed;
    const double begin = cpu_seconds();
    const SearchPlan plan = plan_mate(fixed, moving, form.options);
    RotationSearch search = make_search(plan);
    const double set_up = cpu_seconds();
    search.run();
    const double searched = cpu_seconds();
    const PoseList poses = rank_search(plan, search);
    const double ranked = cpu_seconds();
    std::size_t first = 0;
    double error = 0.0;
    for (std::size_t i = 0; i < poses.poses.size() && first == 0; ++i) {
      error = placement.error(compose(poses.poses[i].moving_in_fixed, plan.start)).largest;
      if (error <= kFound) first = i + 1;
    }
    std::printf("%s,%s,%ld,%ld,%.2f,%.2f,%.2f,%zu,%.3f\n", truth.name.c_str(), form.name.c_str(),
                static_cast<long>(plan.fixed.knots.size()),
                static_cast<long>(plan.moving.knots.size()), set_up - begin, searched - set_up,
                ranked - searched, first, 100.0 * error);
    std::fflush(stdout);
  }
}

void run(const std::vector<std::string>& arguments) {
  if (arguments.size() < 5) throw InputError("expected PARTS_FOLDER SEED FIRST STEP FORM...");
  const std::vector<TrueMate> mates = read_true_mates(arguments[0] + "/mates.json");
  const std::uint64_t seed = std::stoull(arguments[1]);
  std::vector<Form> forms;
  for (std::size_t i = 4; i < arguments.size(); ++i) forms.push_back(parse_form(arguments[i]));
  std::printf("pair,form,fixed_knots,moving_knots,set_up_cpu,search_cpu,rank_cpu,rank,error\n");
  for (std::size_t i = std::stoul(arguments[2]); i < mates.size(); i += std::stoul(arguments[3]))
    run_pair(arguments[0], mates[i], seed, forms);
}

}  // namespace
}  // namespace mortise

int main(int argc, char** argv) {
  return mortise::bench::bench_main("part_forms", argc, argv, mortise::run);
}
