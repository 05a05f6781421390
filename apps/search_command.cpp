// SPDX-License-Identifier: GPL-3.0-or-later
// The course of a search command: parse, call, print.
#include "search_command.hpp"

#include <cstdio>
#include <filesystem>
#include <memory>
#include <numbers>
#include <optional>

#include "ball_body.hpp"
#include "clearances.hpp"
#include "clock.hpp"
#include "interrupt.hpp"
#include "mortise/core/errors.hpp"
#include "mortise/core/threads.hpp"
#include "option_flags.hpp"
#include "output_guard.hpp"
#include "pose_table.hpp"

namespace mortise::app {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

template <class Options>
struct SearchFlags {
  CommonOptions common;
  OptionFlags<Options> options;
  std::string fixed;
  std::string moving;
  std::string output;
  double checkpoint_seconds = RunWatch{}.checkpoint_seconds;
  bool resume = false;
  bool force = false;
};

std::size_t rotations_done(const Run& run) {
  std::size_t count = 0;
  for (const std::uint8_t done : run.rotations.done) count += done;
  return count;
}

double figure(const Run& run, const std::string& name) {
  for (const Figure& f : run.figures)
    if (f.name == name) return f.value;
  return 0.0;
}

void print_json(const std::string& output, const Run& run, const Json& more) {
  Json json = {{"rotations", rotations_done(run)},
               {"poses", run.poses.poses.size()},
               {"seconds", run.seconds},
               {"best_score", nullptr},
               {"file", output},
               {"complete", run.complete}};
  for (const Figure& f : run.figures)
    if (!is_clearance_figure(f)) json[f.name] = f.value;
  add_clearances(json, run);
  if (!run.poses.poses.empty()) json["best_score"] = run.poses.poses.front().score;
  json.update(more);
  std::printf("%s\n", json.dump(-1, ' ', false, Json::error_handler_t::replace).c_str());
}

// Commands to go on with, one per line.
std::string next_steps(const Run& run, const std::string& output) {
  if (of_molecules(run))
    return "  mortise export " + output + " --format pdb --top 10 --complex\n" +
           "  mortise evaluate " + output + " --reference-fixed FILE --reference-moving FILE\n";
  if (run.moving.kind == "molecule")
    return "  mortise export " + output + " --format pdb --top 10\n";
  return "  mortise export " + output + " --format stl --pose 1 --complex\n" +
         "  mortise evaluate " + output + " --reference-pose FILE\n";
}

void print_result(const SearchWords& words, const std::string& output, const Run& run,
                  int threads) {
  std::printf(
      "search    %zu of %zu rotations (within %.1f degrees of any), grid %g x %g x %g at "
      "%g%s, %d %s\n",
      rotations_done(run), run.rotations.done.size(),
      run.rotations.covering_radius * 180.0 / std::numbers::pi, figure(run, "grid_x"),
      figure(run, "grid_y"), figure(run, "grid_z"), figure(run, "grid_spacing"), words.unit,
      threads, threads == 1 ? "thread" : "threads");
  std::printf("found     %zu poses in %.1f s\n%s\n%s\n", run.poses.poses.size(), run.seconds,
              clearance_lines(run).c_str(), pose_table(run, 10).c_str());
  std::printf("wrote %s; to go on:\n%s", output.c_str(),
              next_steps(run, shell_word(output)).c_str());
}

void print_body(const char* label, const Body& body) {
  std::printf("%-9s %s: %s\n", label, body.record.spec.c_str(), size_text(body).c_str());
  for (const std::string& decision : body.decisions)
    std::printf("          %s\n", decision.c_str());
}

// Everything that the two commands do with one set of flags.
template <class Options>
class SearchCommand {
 public:
  SearchCommand(const RunKind<Options>& kind, const SearchWords& words,
                const SearchFlags<Options>& flags)
      : kind_(kind), words_(words), flags_(flags) {}

  void run() {
    check_output();
    if (flags_.resume && fs::exists(flags_.output)) {
      take_up(read_run(flags_.output));
      if (earlier_->complete) {
        if (flags_.common.json) print_json(flags_.output, *earlier_, {{"resumed", false}});
        if (text_) std::printf("%s is complete already; nothing to do\n", flags_.output.c_str());
        return;
      }
    } else {
      start_anew();
    }
    const double seconds_read = seconds_since(begin_);
    SearchPlan plan = kind_.plan(fixed_, moving_, options_);
    const double seconds_plan = seconds_since(begin_) - seconds_read;
    Run run = run_plan(plan, provenance_, watch(), earlier_ ? &*earlier_ : nullptr);
    finish(run, plan, seconds_read, seconds_plan);
  }

 private:
  // A run file is an answer for good: it is replaced or gone on with only where the user says so.
  void check_output() const {
    std::vector<std::string> inputs;
    for (const std::string& spec : {flags_.fixed, flags_.moving})
      if (!spec.empty()) inputs.push_back(body_path(spec));
    check_output_file(flags_.output, inputs, flags_.resume || flags_.force,
                      "--resume goes on with it, --force replaces it");
  }

  ReadBodyOptions reading() const {
    ReadBodyOptions reading = kind_.reading(options_);
    reading.threads = flags_.common.threads;
    return reading;
  }

  void take_up(Run run) {
    earlier_ = std::move(run);
    if (earlier_->kind != kind_.name)
      throw InputError("--resume: " + flags_.output + " is a " + earlier_->kind + " run, not " +
                       "one of " + kind_.name);
    provenance_ = earlier_->provenance;
    options_ = kind_.parse(provenance_.options_json);
    expect_same_options(provenance_.options_json,
                        kind_.to_json(resolve(kind_, flags_.options, {options_})), "--resume");
    options_.threads = flags_.common.threads;
    if (earlier_->complete) return;
    const auto read = [&](const BodyRecord& record, const char* name, const std::string& spec) {
      try {
        return read_recorded_body(record, provenance_, name, {.path = spec}, reading());
      } catch (const FileError&) {
        throw;
      } catch (const InputError& e) {
        throw InputError(std::string("--resume: ") + e.what());
      }
    };
    fixed_ = read(earlier_->fixed, "fixed", flags_.fixed);
    moving_ = read(earlier_->moving, "moving", flags_.moving);
  }

  void start_anew() {
    if (flags_.moving.empty())
      throw InputError(std::string(kind_.name) + ": expected two inputs, FIXED and MOVING, got " +
                       (flags_.fixed.empty() ? "none" : "one"));
    options_ = resolve(kind_, flags_.options);
    options_.threads = flags_.common.threads;
    provenance_ =
        make_provenance(command_line(), kind_.to_json(options_), options_.random_start.value_or(0));
    fixed_ = read_body(flags_.fixed, reading());
    moving_ = read_body(flags_.moving, reading());
  }

  void print_inputs() const {
    print_body(words_.fixed_label, fixed_);
    print_body(words_.moving_label, moving_);
    if (options_.random_start)
      std::printf("start     %s moved at random by seed %llu; poses refer to the file as it is\n",
                  words_.started, static_cast<unsigned long long>(*options_.random_start));
  }

  [[nodiscard]] RunWatch watch() const {
    const std::string go_on = this->go_on();
    RunWatch watch;
    watch.prepared = [this](const std::vector<std::string>& decisions) {
      install_interrupt_handler();  // from here there is something to save
      if (!text_) return;
      print_inputs();
      for (const std::string& decision : decisions) std::printf("search    %s\n", decision.c_str());
      std::fflush(stdout);
    };
    watch.ranking = [this, go_on](bool stopped) {
      const std::string saved = "the search is in " + flags_.output + "; " + go_on;
      exit_at_once_on_interrupt(saved);
      if (!stopped && interrupted()) throw Interrupted(saved);
      if (stopped && !flags_.common.quiet)
        std::fprintf(stderr,
                     "mortise: stopping; the best placements so far are worked out (Ctrl-C: "
                     "without them)\n");
    };
    watch.progress = make_progress(words_.label, flags_.common);
    watch.checkpoint_seconds = flags_.checkpoint_seconds;
    watch.save = [this](const Run& unfinished) { write_run(flags_.output, unfinished); };
    return watch;
  }

  [[nodiscard]] std::string go_on() const {
    return "go on with: mortise " + std::string(kind_.name) + " -o " + shell_word(flags_.output) +
           " --resume";
  }

  void finish(Run& run, const SearchPlan& plan, double seconds_read, double seconds_plan) const {
    const int threads = resolve_threads(flags_.common.threads);
    run.seconds = (earlier_ ? earlier_->seconds : 0.0) + seconds_since(begin_);
    if (run.complete && !earlier_) {
      run.figures.push_back({"threads", static_cast<double>(threads)});
      run.figures.push_back({"seconds_read", seconds_read});
      run.figures.push_back({"seconds_plan", seconds_plan});
      run.figures.push_back({"peak_memory_mb", peak_memory_mb()});
    }
    write_run(flags_.output, run);
    if (!run.complete)
      throw Interrupted(std::to_string(rotations_done(run)) + " of " +
                        std::to_string(run.rotations.done.size()) + " rotations are in " +
                        flags_.output + "; " + go_on());
    if (run.poses.poses.empty() && !flags_.common.quiet)
      std::fprintf(stderr, "mortise: %s: the search found no pose\n", flags_.output.c_str());
    if (flags_.common.json) {
      std::vector<std::string> decisions;
      for (const Body* body : {&fixed_, &moving_})
        for (const std::string& decision : body->decisions)
          decisions.push_back(body->record.spec + ": " + decision);
      decisions.insert(decisions.end(), plan.decisions.begin(), plan.decisions.end());
      print_json(flags_.output, run,
                 {{"grid", {figure(run, "grid_x"), figure(run, "grid_y"), figure(run, "grid_z")}},
                  {"spacing", figure(run, "grid_spacing")},
                  {"threads", threads},
                  {"resumed", earlier_.has_value()},
                  {"decisions", decisions}});
    }
    if (text_) print_result(words_, flags_.output, run, threads);
  }

  const RunKind<Options>& kind_;
  const SearchWords& words_;
  const SearchFlags<Options>& flags_;
  const Clock::time_point begin_ = Clock::now();
  const bool text_ = !flags_.common.quiet && !flags_.common.json;
  std::optional<Run> earlier_;
  Provenance provenance_;
  Options options_;
  Body fixed_, moving_;
};

template <class Options>
void add_command(CLI::App& program, const RunKind<Options>& kind, const SearchWords& words) {
  auto flags = std::make_shared<SearchFlags<Options>>();
  CLI::App& command = *program.add_subcommand(kind.name, words.description);
  command.add_option("FIXED", flags->fixed, words.fixed);
  command.add_option("MOVING", flags->moving, words.moving);
  command.add_option("-o,--output", flags->output, "Run file to write (HDF5)")->required();
  add_option_flags(command, kind, flags->options, words.preset_help);
  CLI::Option* resume =
      command.add_flag("--resume", flags->resume,
                       "Go on with the run file if it is there, with its inputs and options");
  command.add_flag("--force", flags->force, "Replace the run file if it is there")
      ->excludes(resume);
  command
      .add_option("--checkpoint", flags->checkpoint_seconds,
                  "Seconds between two saves of the unfinished run")
      ->capture_default_str()
      ->check(CLI::NonNegativeNumber);
  add_common_options(command, flags->common, words.examples);
  command.callback([&kind, words, flags] { SearchCommand<Options>(kind, words, *flags).run(); });
}

}  // namespace

void add_search_command(CLI::App& program, const RunKind<DockOptions>& kind,
                        const SearchWords& words) {
  add_command(program, kind, words);
}

void add_search_command(CLI::App& program, const RunKind<MateOptions>& kind,
                        const SearchWords& words) {
  add_command(program, kind, words);
}

}  // namespace mortise::app
