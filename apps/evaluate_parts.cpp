// SPDX-License-Identifier: GPL-3.0-or-later
// Placement errors of a mating run.
#include "evaluate_parts.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <optional>

#include "mortise/core/errors.hpp"
#include "mortise/core/threads.hpp"
#include "mortise/metrics/placement.hpp"
#include "mortise/metrics/true_mates.hpp"
#include "mortise/report/interface_columns.hpp"
#include "mortise/store/atomic_file.hpp"
#include "mortise/store/body.hpp"
#include "pose_table.hpp"

namespace mortise::app {
namespace {

using Json = nlohmann::ordered_json;

std::string stem_of(const BodyRecord& body) {
  return std::filesystem::path(body.path).stem().string();
}

std::optional<int> first_within(const std::vector<double>& largest, double limit) {
  const auto found =
      std::find_if(largest.begin(), largest.end(), [&](double e) { return e <= limit; });
  if (found == largest.end()) return {};
  return static_cast<int>(found - largest.begin()) + 1;
}

}  // namespace

void evaluate_parts(const std::string& run_path, const std::string& truth, const std::string& pair,
                    const LocateOptions& moving, const CommonOptions& common) {
  Run run = read_run(run_path);
  if (run.poses.poses.empty()) throw InputError("evaluate: " + run_path + " holds no poses yet");
  check_writable(run_path);
  TrueMate mate =
      find_true_mate(read_true_mates(truth), stem_of(run.fixed), stem_of(run.moving), pair);
  if (mate.name.empty()) mate.name = stem_of(run.fixed) + " " + stem_of(run.moving);
  const Placement placement(
      body_mesh(read_input_body(run.moving, run.provenance, "moving", moving)), mate);
  const std::size_t count = run.poses.poses.size();
  MetricColumn largest{"placement_largest", std::vector<double>(count)};
  MetricColumn rms{"placement_rms", std::vector<double>(count)};
  parallel_for(count, common.threads, [&](std::size_t i, int) {
    const PlacementError error = placement.error(run.poses.poses[i].moving_in_fixed);
    largest.values[i] = error.largest;
    rms.values[i] = error.rms;
  });
  const std::optional<int> first = first_within(largest.values, 0.02);
  const double best = *std::min_element(largest.values.begin(), largest.values.end());
  Json json = {
      {"first_acceptable", nullptr},  // of molecules
      {"first_medium", nullptr},
      {"first_high", nullptr},
      {"first_irmsd_2_5", nullptr},
      {"first_within_2_percent", first ? Json(*first) : Json()},
      {"error_of_first",
       first ? Json(largest.values[static_cast<std::size_t>(*first - 1)]) : Json()},
      {"rms_of_first", first ? Json(rms.values[static_cast<std::size_t>(*first - 1)]) : Json()},
      {"best_placement_largest", best},
      {"best_placement_rms", *std::min_element(rms.values.begin(), rms.values.end())},
      {"diameter", placement.diameter()},
      {"pair", mate.name},
      {"poses", count}};
  set_metric_columns(run, {std::move(largest), std::move(rms)});
  write_run(run_path, run);
  if (common.json) {
    std::printf("%s\n", json.dump(-1, ' ', false, Json::error_handler_t::replace).c_str());
  } else if (!common.quiet) {
    std::printf("pair         %s, diameter %g\n", mate.name.c_str(), placement.diameter());
    std::printf("best         largest distance %.3f%% of the diameter, of any pose\n\n",
                100 * best);
    std::printf("Rank of the first of %zu poses that is\n  within 2%% of the diameter   %s\n\n%s",
                count, first ? std::to_string(*first).c_str() : "none",
                pose_table(run, 10).c_str());
  }
}

}  // namespace mortise::app
