// SPDX-License-Identifier: GPL-3.0-or-later
// Reading parts, random start, mating, exact checks.
#include "mating_job.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

#include "mortise/core/errors.hpp"
#include "mortise/metrics/contact.hpp"
#include "mortise/parts/diameter.hpp"
#include "mortise/parts/mesh_solid.hpp"
#include "mortise/parts/read_part.hpp"
#include "mortise/store/inputs.hpp"

namespace mortise::app {
namespace {

MateBody read_body(const BodyRecord& record, const std::string& path,
                   const MateSettings& settings) {
  ReadPartOptions options;
  options.absolute_deviation = settings.deviation;
  options.repair.allow_open = settings.allow_open;
  ReadPartResult read = read_part(path, options);
  MateBody body{record, {}, std::move(read.decisions)};
  body.record.unit = read.unit;
  body.part.solid = std::make_shared<MeshSolid>(read.mesh);
  body.part.mesh = std::move(read.mesh);
  return body;
}

void check_contacts(const MateBody& fixed, const MateBody& moving, const MateSettings& settings,
                    Run& run) {
  constexpr const char* kNames[] = {
      "contact_area", "penetration_volume", "penetration_depth", "pull_blocked", "pull_x", "pull_y",
      "pull_z"};
  for (const char* name : kNames)
    run.metrics.push_back({name, std::vector<double>(run.poses.poses.size(), std::nan(""))});
  const std::size_t count =
      std::min(run.poses.poses.size(), static_cast<std::size_t>(settings.checked));
  for (std::size_t i = 0; i < count; ++i) {
    const ContactReport report = measure_contact(
        fixed.part.mesh, *fixed.part.solid, moving.part.mesh, *moving.part.solid,
        run.poses.poses[i].moving_in_fixed,
        {.tolerance = settings.options.tolerance, .threads = settings.options.threads});
    const double values[] = {report.contact_area,      report.penetration_volume,
                             report.penetration_depth, report.pull_blocked,
                             report.pull_direction[0], report.pull_direction[1],
                             report.pull_direction[2]};
    for (std::size_t m = 0; m < std::size(kNames); ++m) run.metrics[m].values[i] = values[m];
  }
}

// What is said where the grid has to be coarser than asked for.
std::vector<std::string> step_decisions(Mating& mating, const MateOptions& options) {
  const double coarser = mating.search().spacing() / (options.spacing * mating.smaller_diameter());
  if (coarser < 1.0 + 1e-6) return {};
  char text[200];
  std::snprintf(text, sizeof text,
                "grid step and skin %.3g times those asked for (%.3g, %.3g of the smaller part's "
                "diameter): finer ones need more than --most-cells %g",
                coarser, options.spacing * coarser, options.skin * coarser, options.most_cells);
  return {text};
}

}  // namespace

MateBody read_mate_body(const std::string& path, const MateSettings& settings) {
  BodyRecord record;
  record.path = path;
  record.spec = path;
  MateBody body = read_body(record, path, settings);
  body.record.sha256 = sha256_of_file(path);
  return body;
}

MateBody read_recorded_part(const BodyRecord& record, const Provenance& provenance,
                            const std::string& name, const std::string& path,
                            const MateSettings& settings) {
  BodyRecord bare = record;
  bare.knots = {};
  return read_body(bare, locate_input(record, provenance, name, {.path = path}), settings);
}

void expect_one_unit(MateBody& fixed, MateBody& moving) {
  const std::string &a = fixed.record.unit, &b = moving.record.unit;
  if (!a.empty() && !b.empty() && a != b)
    throw InputError("mate: expected both parts in one unit, found " + fixed.record.spec + " in " +
                     a + " and " + moving.record.spec + " in " + b);
  if (a.empty() == b.empty()) return;
  MateBody& without = a.empty() ? fixed : moving;
  without.decisions.push_back("the file knows no unit: its lengths are taken as " +
                              (a.empty() ? b : a) + ", the other part's");
}

SearchResult mate(const MateBody& fixed, const MateBody& moving, const MateSettings& settings,
                  const Provenance& provenance, const SearchWatch& watch, const Run* earlier) {
  const auto begin = std::chrono::steady_clock::now();
  RigidMotion start;
  MatePart started = moving.part;
  if (settings.random_start) {
    start = random_start(*settings.random_start, 0.5 * diameter_of(moving.part.mesh.vertices));
    started.mesh.vertices = start * started.mesh.vertices;
    started.solid = std::make_shared<MeshSolid>(started.mesh);
  }
  MateOptions options = settings.options;
  if (options.axis) options.axis->moving = start.rotation * options.axis->moving;
  Mating mating(fixed.part, started, options);
  SearchResult result =
      run_search({"mate", fixed.record, moving.record, mating.fixed_knots(), mating.moving_knots(),
                  start, &mating.rotations(), &mating.search(), [&] { return mating.rank(); },
                  begin, step_decisions(mating, options)},
                 provenance, watch, earlier);
  if (result.run.complete) {
    const auto checks = std::chrono::steady_clock::now();
    check_contacts(fixed, moving, settings, result.run);
    result.run.figures.push_back(
        {"seconds_check",
         std::chrono::duration<double>(std::chrono::steady_clock::now() - checks).count()});
  }
  return result;
}

}  // namespace mortise::app
