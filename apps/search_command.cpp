// SPDX-License-Identifier: GPL-3.0-or-later
// The course of a search command.
#include "search_command.hpp"

#include <cstdio>
#include <filesystem>
#include <numbers>

#include "clock.hpp"
#include "mortise/core/errors.hpp"
#include "mortise/core/threads.hpp"
#include "mortise/store/atomic_file.hpp"
#include "pose_table.hpp"

namespace mortise::app {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// A run file is an answer for good: it is replaced or gone on with only where the user says so.
void check_output(const SearchCommand& command, const SearchOptionsCommon& options) {
  for (const std::string& text : {options.fixed, options.moving})
    if (!text.empty()) refuse_to_overwrite_input(options.output, command.file_of(text));
  if (!options.resume && !options.force && fs::exists(options.output))
    throw FileError(options.output,
                    "exists already (--resume goes on with it, --force replaces it)");
  check_writable(options.output);
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

void print_result(const SearchCommand& command, const std::string& output,
                  const SearchResult& result, int threads) {
  const Run& run = result.run;
  const auto [nx, ny, nz] = result.figures.grid_size;
  const std::string unit = command.unit();
  std::printf(
      "search    %zu of %zu rotations (within %.1f degrees of any), grid %d x %d x %d at "
      "%g%s, %d %s\n",
      rotations_done(run), run.rotations.done.size(),
      run.rotations.covering_radius * 180.0 / std::numbers::pi, nx, ny, nz, result.figures.spacing,
      unit.c_str(), threads, threads == 1 ? "thread" : "threads");
  std::printf("found     %zu poses in %.1f s\n\n%s\n", run.poses.poses.size(), run.seconds,
              pose_table(run, 10).c_str());
  std::printf("wrote %s; to go on:\n%s", output.c_str(),
              command.next_steps(shell_word(output)).c_str());
}

}  // namespace

void add_search_flags(CLI::App& command, SearchOptionsCommon& options,
                      const std::string& examples) {
  CLI::Option* resume = command.add_flag(
      "--resume", options.resume,
      "Go on with the run file, if it is there; inputs and options are those of the file");
  command.add_flag("--force", options.force, "Replace the run file if it is there")
      ->excludes(resume);
  command
      .add_option("--checkpoint", options.checkpoint_seconds,
                  "Save the unfinished run every so many seconds")
      ->capture_default_str()
      ->check(CLI::NonNegativeNumber);
  add_common_options(command, options.common, examples);
}

void expect_same_settings(const Json& recorded, const Json& asked, const std::string& who) {
  const auto text = [](const Json& all, const std::string& key) {
    return all.contains(key) ? all[key].dump() : "nothing";
  };
  const auto compare = [&](const std::string& key) {
    if (text(recorded, key) != text(asked, key))
      throw InputError(who + ": " + key + " differs: the file was begun with " +
                       text(recorded, key) + ", asked for now is " + text(asked, key));
  };
  for (const auto& item : recorded.items()) compare(item.key());
  for (const auto& item : asked.items()) compare(item.key());
}

void run_search_command(SearchCommand& command, const SearchOptionsCommon& options) {
  const auto begin = Clock::now();
  const bool text = !options.common.quiet && !options.common.json;
  check_output(command, options);
  std::optional<Run> earlier;
  Provenance provenance;
  if (options.resume && fs::exists(options.output)) {
    earlier = read_run(options.output);
    if (earlier->kind != command.name())
      throw InputError("--resume: " + options.output + " is a " + earlier->kind + " run, not " +
                       "one of " + command.name());
    command.take_settings(*earlier);
    provenance = earlier->provenance;
    if (earlier->complete) {
      if (options.common.json) print_json(options.output, *earlier, {{"resumed", false}});
      if (text) std::printf("%s is complete already; nothing to do\n", options.output.c_str());
      return;
    }
  } else {
    if (options.moving.empty())
      throw InputError(command.name() + ": expected two inputs, FIXED and MOVING, got " +
                       std::string(options.fixed.empty() ? "none" : "one"));
    const auto [settings, seed] = command.make_settings();
    provenance = make_provenance(command_line(), settings, seed);
  }
  command.read(earlier ? &*earlier : nullptr);
  const double seconds_read = seconds_since(begin);

  const double seconds_before = earlier ? earlier->seconds : 0.0;
  SearchWatch watch;
  if (text)
    watch.prepared = [&] {
      command.print_inputs();
      std::fflush(stdout);
    };
  watch.progress = make_progress(command.label(), options.common);
  watch.checkpoint_seconds = options.checkpoint_seconds;
  watch.save = [&](const Run& unfinished) {
    Run run = unfinished;
    run.seconds = seconds_before + seconds_since(begin);
    write_run(options.output, run);
  };
  SearchResult result = command.search(provenance, watch, earlier ? &*earlier : nullptr);
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
                      options.output + "; go on with: mortise " + command.name() + " -o " +
                      shell_word(options.output) + " --resume");
  if (options.common.json)
    print_json(options.output, run,
               {{"grid", result.figures.grid_size},
                {"spacing", result.figures.spacing},
                {"threads", threads},
                {"resumed", earlier.has_value()},
                {"decisions", command.decisions()}});
  if (text) print_result(command, options.output, result, threads);
}

}  // namespace mortise::app
