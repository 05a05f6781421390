// SPDX-License-Identifier: GPL-3.0-or-later
// mortise dock: searches all placements of one molecule against another.
#include "mortise/search/dock.hpp"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <numbers>

#include "commands.hpp"
#include "docking_job.hpp"
#include "mortise/core/errors.hpp"
#include "mortise/core/threads.hpp"
#include "mortise/store/atomic_file.hpp"
#include "pose_table.hpp"

namespace mortise::app {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using Json = nlohmann::ordered_json;

struct Options {
  CommonOptions common;
  std::string fixed;
  std::string moving;
  std::string output;
  DockArguments arguments;
  double checkpoint_seconds = DockWatch{}.checkpoint_seconds;
  bool resume = false;
  bool force = false;
};

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// What the run works on: read anew, or taken from the run file to go on with.
struct Inputs {
  std::optional<Run> earlier;
  DockSettings settings;
  Provenance provenance;
  DockBody fixed, moving;
};

void refuse_to_overwrite_input(const std::string& output, const std::string& text) {
  std::error_code error;
  if (!text.empty() && fs::equivalent(output, parse_molecule_spec(text).path, error) && !error)
    throw FileError(output, "expected a file to write, found an input");
}

Inputs read_inputs(const Options& options) {
  Inputs inputs;
  if (options.resume && fs::exists(options.output)) {
    inputs.earlier = read_run(options.output);
    Run& run = *inputs.earlier;
    if (run.kind != "dock")
      throw InputError("--resume: " + options.output + " is a " + run.kind + " run, not a docking");
    inputs.settings = parse_settings(run.provenance.options_json);
    expect_same_settings(settings_json(inputs.settings),
                         settings_json(resolve(options.arguments, inputs.settings)), "--resume");
    inputs.provenance = run.provenance;
    if (run.complete) return inputs;
    inputs.fixed =
        read_recorded_body(run.fixed, run.provenance, "fixed", options.fixed, inputs.settings.read);
    inputs.moving = read_recorded_body(run.moving, run.provenance, "moving", options.moving,
                                       inputs.settings.read);
    return inputs;
  }
  if (options.moving.empty())
    throw InputError("dock: expected two structures, FIXED and MOVING, got " +
                     std::string(options.fixed.empty() ? "none" : "one"));
  inputs.settings = resolve(options.arguments);
  inputs.provenance = make_provenance(command_line(), settings_json(inputs.settings).dump(),
                                      inputs.settings.random_start.value_or(0));
  inputs.fixed = read_dock_body(options.fixed, inputs.settings.read);
  inputs.moving = read_dock_body(options.moving, inputs.settings.read);
  return inputs;
}

void print_inputs(const Inputs& inputs) {
  for (const auto& [label, body] :
       {std::pair{"receptor", &inputs.fixed}, std::pair{"ligand", &inputs.moving}}) {
    std::printf("%-9s %s: %zu atoms\n", label, body->record.spec.c_str(),
                body->molecule.atoms.size());
    for (const std::string& decision : body->decisions)
      std::printf("          %s\n", decision.c_str());
  }
  if (inputs.settings.random_start)
    std::printf("start     ligand moved at random by seed %llu; poses refer to the file as it is\n",
                static_cast<unsigned long long>(*inputs.settings.random_start));
  std::fflush(stdout);
}

void add_figure(Run& run, const char* name, double value) { run.figures.push_back({name, value}); }

std::size_t rotations_done(const Run& run) {
  std::size_t count = 0;
  for (const std::uint8_t done : run.rotations.done) count += done;
  return count;
}

void print_json(const std::string& output, const Run& run, const Json& more) {
  Json json = {{"rotations", rotations_done(run)},
               {"poses", run.poses.poses.size()},
               {"seconds", run.seconds},
               {"fft_ratio", nullptr},
               {"best_score", nullptr},
               {"file", output},
               {"complete", run.complete}};
  for (const Figure& figure : run.figures) json[figure.name] = figure.value;
  if (!run.poses.poses.empty()) json["best_score"] = run.poses.poses.front().score;
  json.update(more);
  std::printf("%s\n", json.dump(-1, ' ', false, Json::error_handler_t::replace).c_str());
}

void print_result(const std::string& output, const DockResult& result, int threads) {
  const Run& run = result.run;
  const auto [nx, ny, nz] = result.figures.grid_size;
  std::printf(
      "search    %zu of %zu rotations (within %.1f degrees of any), grid %d x %d x %d at "
      "%g A, %d %s\n",
      rotations_done(run), run.rotations.done.size(),
      run.rotations.covering_radius * 180.0 / std::numbers::pi, nx, ny, nz, result.figures.spacing,
      threads, threads == 1 ? "thread" : "threads");
  std::printf("found     %zu poses in %.1f s\n\n%s\n", run.poses.poses.size(), run.seconds,
              pose_table(run, 10).c_str());
  const std::string name = shell_word(output);
  std::printf("wrote %s; to go on:\n", output.c_str());
  std::printf("  mortise export %s --format pdb --top 10 --complex\n", name.c_str());
  std::printf("  mortise evaluate %s --reference-fixed FILE --reference-moving FILE\n",
              name.c_str());
}

// A run file is an answer for good: it is replaced or gone on with only where the user says so.
void check_output(const Options& options) {
  refuse_to_overwrite_input(options.output, options.fixed);
  refuse_to_overwrite_input(options.output, options.moving);
  if (!options.resume && !options.force && fs::exists(options.output))
    throw FileError(options.output,
                    "exists already (--resume goes on with it, --force replaces it)");
  check_writable(options.output);
}

void execute(const Options& options) {
  const auto begin = Clock::now();
  const bool text = !options.common.quiet && !options.common.json;
  check_output(options);
  Inputs inputs = read_inputs(options);
  if (inputs.earlier && inputs.earlier->complete) {
    if (options.common.json) print_json(options.output, *inputs.earlier, {{"resumed", false}});
    if (text) std::printf("%s is complete already; nothing to do\n", options.output.c_str());
    return;
  }
  inputs.settings.options.threads = options.common.threads;
  const double seconds_read = seconds_since(begin);

  const double seconds_before = inputs.earlier ? inputs.earlier->seconds : 0.0;
  DockWatch watch;
  if (text) watch.prepared = [&] { print_inputs(inputs); };
  watch.progress = make_progress("docking", options.common);
  watch.checkpoint_seconds = options.checkpoint_seconds;
  watch.save = [&](const Run& unfinished) {
    Run run = unfinished;
    run.seconds = seconds_before + seconds_since(begin);
    write_run(options.output, run);
  };
  DockResult result = dock(inputs.fixed, inputs.moving, inputs.settings, inputs.provenance, watch,
                           inputs.earlier ? &*inputs.earlier : nullptr);
  Run& run = result.run;
  const int threads = resolve_threads(options.common.threads);
  run.seconds = seconds_before + seconds_since(begin);
  if (run.complete && result.figures.whole) {
    add_figure(run, "threads", threads);
    add_figure(run, "seconds_read", seconds_read);
    add_figure(run, "seconds_prepare", result.figures.seconds_prepare);
    add_figure(run, "seconds_search", result.figures.seconds_search);
    add_figure(run, "seconds_rank", result.figures.seconds_rank);
    add_figure(run, "peak_memory_mb", peak_memory_mb());
    if (options.common.json)
      add_figure(run, "fft_ratio",
                 result.figures.seconds_search * threads /
                     (static_cast<double>(run.rotations.done.size()) *
                      bare_fft_seconds(result.figures.grid_size)));
  }
  write_run(options.output, run);
  if (!run.complete)
    throw Interrupted(std::to_string(rotations_done(run)) + " of " +
                      std::to_string(run.rotations.done.size()) + " rotations are in " +
                      options.output + "; go on with: mortise dock -o " +
                      shell_word(options.output) + " --resume");
  if (options.common.json) {
    Json decisions = Json::array();
    for (const DockBody* body : {&inputs.fixed, &inputs.moving})
      for (const std::string& decision : body->decisions)
        decisions.push_back(body->record.spec + ": " + decision);
    print_json(options.output, run,
               {{"grid", result.figures.grid_size},
                {"spacing", result.figures.spacing},
                {"threads", threads},
                {"resumed", inputs.earlier.has_value()},
                {"decisions", decisions}});
  }
  if (text) print_result(options.output, result, threads);
}

}  // namespace

void add_dock(CLI::App& program) {
  auto options = std::make_shared<Options>();
  CLI::App& command = *program.add_subcommand(
      "dock", "Search all placements of one molecule against another, write ranked poses");
  command.add_option("FIXED", options->fixed,
                     "Receptor: PDB or mmCIF file, .gz too; FILE#MODEL:CHAIN,CHAIN for a part");
  command.add_option("MOVING", options->moving, "Ligand, likewise");
  command.add_option("-o,--output", options->output, "Run file to write (HDF5)")->required();
  add_dock_options(command, options->arguments);
  command
      .add_option_function<std::uint64_t>(
          "--random-start",
          [options](const std::uint64_t& seed) {
            options->arguments.overrides.emplace_back(
                [seed](DockSettings& s) { s.random_start = seed; });
          },
          "Move the ligand at random first, by this seed: for tests on complexes whose ligand "
          "already sits right")
      ->default_str("none");
  CLI::Option* resume = command.add_flag(
      "--resume", options->resume,
      "Go on with the run file, if it is there; inputs and options are those of the file");
  command.add_flag("--force", options->force, "Replace the run file if it is there")
      ->excludes(resume);
  command
      .add_option("--checkpoint", options->checkpoint_seconds,
                  "Save the unfinished run every so many seconds")
      ->capture_default_str()
      ->check(CLI::NonNegativeNumber);
  add_common_options(
      command, options->common,
      "  mortise dock receptor.pdb ligand.pdb -o run.h5\n"
      "  mortise dock complex.cif.gz:A,B complex.cif.gz:C -o run.h5 --preset thorough\n"
      "  mortise dock receptor.pdb ligand.pdb -o run.h5 --rotations 54000 --json\n"
      "  mortise dock -o run.h5 --resume\n"
      "Ctrl-C saves the run so far, with the best poses of it, and exits with 130.");
  command.callback([options] { execute(*options); });
}

}  // namespace mortise::app
