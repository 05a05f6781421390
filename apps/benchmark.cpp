// SPDX-License-Identifier: GPL-3.0-or-later
// mortise benchmark: docks a table of known complexes and counts successes.
#include "mortise/runs/benchmark.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <memory>
#include <thread>

#include "clock.hpp"
#include "commands.hpp"
#include "mortise/core/errors.hpp"
#include "mortise/core/version.hpp"
#include "mortise/report/pictures.hpp"
#include "mortise/runs/processes.hpp"
#include "mortise/runs/run_kind.hpp"
#include "mortise/store/atomic_file.hpp"
#include "option_flags.hpp"

namespace mortise::app {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct BenchmarkFlags {
  CommonOptions common;
  std::string table;
  std::string output;
  std::string fold;
  std::vector<std::string> subset;
  OptionFlags<DockOptions> options;
  std::uint64_t seed = 1;
  std::string runs;
  int jobs = 1;
  bool force = false;
  bool png = false;
};

std::string text_of(double value) {
  char text[64];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

// "i/k": every k-th row from the i-th on.
std::pair<std::size_t, std::size_t> parse_fold(const std::string& text) {
  if (text.empty()) return {0, 1};
  unsigned i = 0, k = 0;
  int used = 0;
  if (std::sscanf(text.c_str(), "%u/%u%n", &i, &k, &used) != 2 ||
      static_cast<std::size_t>(used) != text.size() || i < 1 || i > k)
    throw InputError("--fold: expected i/k with 1 <= i <= k, got " + text);
  return {i - 1, k};
}

std::vector<BenchmarkPair> chosen_pairs(const BenchmarkFlags& options) {
  const std::vector<BenchmarkPair> all = read_benchmark_pairs(options.table);
  for (const std::string& name : options.subset)
    if (std::none_of(all.begin(), all.end(), [&](const auto& p) { return p.name == name; }))
      throw InputError("--subset: " + options.table + " has no pair " + name);
  const auto [first, step] = parse_fold(options.fold);
  std::vector<BenchmarkPair> chosen;
  for (std::size_t i = first; i < all.size(); i += step)
    if (options.subset.empty() || std::find(options.subset.begin(), options.subset.end(),
                                            all[i].name) != options.subset.end())
      chosen.push_back(all[i]);
  if (chosen.empty()) throw InputError("benchmark: --fold and --subset leave no pair");
  return chosen;
}

// Docks and measures one pair. @throws Interrupted
ResultRow dock_pair(const BenchmarkPair& pair, const DockOptions& docking,
                    const BenchmarkFlags& options, const std::string& progress_label) {
  CommonOptions common = options.common;
  common.quiet = common.quiet || options.jobs > 1;
  RunWatch watch;
  watch.progress = make_progress(progress_label, common);
  BenchmarkResult result = dock_known_pair(pair, docking, options.seed, command_line(), watch);
  if (!result.run.complete) throw Interrupted(pair.name);
  if (!options.runs.empty())
    write_run((fs::path(options.runs) / (pair.name + ".h5")).string(), result.run);
  return result.row;
}

void print_row(const ResultRow& row, const BenchmarkFlags& options) {
  if (options.common.quiet) return;
  if (!row["error"].empty())
    std::fprintf(stderr, "mortise: warning: pair %s failed: %s\n", row["name"].c_str(),
                 row["error"].c_str());
  else if (!options.common.json) {
    const auto rank = [&](const char* column) {
      return row[column].empty() ? "-" : row[column].c_str();
    };
    std::printf("%-8s %-7s acceptable %5s   i-RMSD 2.5 %5s   best i-RMSD %7s A   %7s s\n",
                row["name"].c_str(), row["difficulty"].c_str(), rank("first_acceptable"),
                rank("first_irmsd_2_5"), row["best_interface_rmsd"].c_str(),
                row["seconds"].c_str());
    std::fflush(stdout);
  }
}

// Docks the pairs, at most options.jobs at a time, each in a process of its own: its memory and
// time are then its own. Gives each row to `keep` as it comes; on Ctrl-C pairs at work are dropped.
void dock_pairs(const std::vector<BenchmarkPair>& pairs, const DockOptions& docking,
                const BenchmarkFlags& options, const std::function<void(const ResultRow&)>& keep) {
  JobHooks hooks;
  hooks.work = [&](std::size_t i) {
    ResultRow row = result_row(pairs[i]);
    const std::string label =
        std::to_string(i + 1) + "/" + std::to_string(pairs.size()) + " " + pairs[i].name;
    try {
      row = dock_pair(pairs[i], docking, options, label);
    } catch (const Interrupted&) {
      throw JobStopped();
    } catch (const InputError& e) {
      row["error"] = e.what();
    } catch (const std::exception& e) {
      row["error"] = std::string("internal error: ") + e.what();
    }
    return csv_line(row);
  };
  hooks.done = [&](std::size_t i, const JobResult& result) {
    if (result.stopped) return;
    ResultRow row = result_row(pairs[i]);
    if (result.failure.empty())
      row = parse_result_row(result.text);
    else
      row["error"] = result.failure;
    row["cpu_seconds"] = text_of(result.cpu_seconds);
    row["peak_memory_mb"] = text_of(result.peak_memory_mb);
    keep(row);
  };
  hooks.stop = interrupted;
  run_in_processes(pairs.size(), options.jobs, hooks);
}

std::string summary_path(const std::string& output) {
  const fs::path path(output);
  return (path.parent_path() / (path.stem().string() + "_summary.csv")).string();
}

std::string picture_path(const std::string& output) {
  const fs::path path(output);
  return (path.parent_path() / (path.stem().string() + "_success.png")).string();
}

void draw_curves(const std::vector<ResultRow>& rows, const std::string& path) {
  std::vector<SuccessCurve> curves = {
      {"acceptable", {}}, {"i-RMSD up to 2.5 \u00c5", {}}, {"medium", {}}};
  const char* const columns[] = {"first_acceptable", "first_irmsd_2_5", "first_medium"};
  for (const ResultRow& row : rows)
    for (std::size_t k = 0; k < curves.size(); ++k) {
      const std::string& text = row[columns[k]];
      curves[k].first_ranks.push_back(text.empty() ? std::numeric_limits<double>::quiet_NaN()
                                                   : std::stod(text));
    }
  draw_success(curves, kSuccessRanks.back(), path);
}

Json success_json(const std::vector<SuccessCount>& counts) {
  Json list = Json::array();
  for (const SuccessCount& count : counts) {
    Json entry = {{"difficulty", count.difficulty},
                  {"criterion", count.criterion},
                  {"pairs", count.pairs},
                  {"failed", count.failed}};
    for (std::size_t k = 0; k < kSuccessRanks.size(); ++k)
      entry["top_" + std::to_string(kSuccessRanks[k])] = count.successes[k];
    entry["median_seconds"] = count.median_seconds ? Json(*count.median_seconds) : Json();
    list.push_back(entry);
  }
  return list;
}

void execute(BenchmarkFlags options) {
  install_interrupt_handler();  // pairs that are done are kept
  DockOptions docking = resolve(dock_kind(), options.options);
  const int cores = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  docking.threads = options.common.threads;
  if (options.common.threads == 0 && options.jobs > 1)
    docking.threads = std::max(1, cores / options.jobs);
  Json recorded = {{"mortise_version", kVersion}, {"seed", options.seed}};
  recorded.update(Json::parse(to_json(docking)));
  recorded.erase("random_start");  // each pair's own
  const std::string record = recorded.dump();

  const std::vector<BenchmarkPair> pairs = chosen_pairs(options);
  check_writable(options.output);
  check_writable(summary_path(options.output));
  if (!options.runs.empty()) {
    std::error_code error;
    fs::create_directories(options.runs, error);
    if (!fs::is_directory(options.runs)) throw FileError(options.runs, "cannot be made a folder");
    check_writable((fs::path(options.runs) / "run.h5").string());
  }
  std::vector<ResultRow> rows;
  if (!options.force) rows = read_results(options.output, record);
  std::erase_if(rows, [](const ResultRow& row) { return !row["error"].empty(); });  // tried again
  const auto row_named = [&](const std::string& name) {
    return std::find_if(rows.begin(), rows.end(),
                        [&](const ResultRow& row) { return row["name"] == name; });
  };
  std::vector<BenchmarkPair> todo;
  for (const BenchmarkPair& pair : pairs)
    if (row_named(pair.name) == rows.end()) todo.push_back(pair);
  if (todo.size() < pairs.size() && !options.common.quiet)
    std::fprintf(stderr, "mortise: %zu of %zu pairs are in %s already\n",
                 pairs.size() - todo.size(), pairs.size(), options.output.c_str());

  dock_pairs(todo, docking, options, [&](const ResultRow& row) {
    rows.push_back(row);
    write_results(options.output, record, rows);
    print_row(row, options);
  });
  std::vector<ResultRow> chosen;
  for (const BenchmarkPair& pair : pairs)
    if (const auto row = row_named(pair.name); row != rows.end()) chosen.push_back(*row);
  if (chosen.size() < pairs.size())
    throw Interrupted(std::to_string(chosen.size()) + " of " + std::to_string(pairs.size()) +
                      " pairs are in " + options.output + "; the same command goes on");

  const std::vector<SuccessCount> counts = count_successes(chosen);
  write_file_atomically(summary_path(options.output), success_csv(counts));
  if (options.png) draw_curves(chosen, picture_path(options.output));
  if (options.common.json) {
    const Json json = {{"pairs", chosen.size()},
                       {"failed", counts.front().failed},
                       {"file", options.output},
                       {"summary", summary_path(options.output)},
                       {"success", success_json(counts)}};
    std::printf("%s\n", json.dump().c_str());
  } else if (!options.common.quiet) {
    std::printf("\n%s\nwrote %s and %s\n", success_text(counts).c_str(), options.output.c_str(),
                summary_path(options.output).c_str());
  }
  std::fflush(stdout);
  for (const ResultRow& row : chosen)
    if (!row["error"].empty())
      throw InputError("benchmark: " + std::to_string(counts.front().failed) + " of " +
                       std::to_string(chosen.size()) + " pairs failed, the first is " +
                       row["name"] + ": " + row["error"]);
}

}  // namespace

void add_benchmark(CLI::App& program) {
  auto options = std::make_shared<BenchmarkFlags>();
  CLI::App& command = *program.add_subcommand(
      "benchmark", "Dock a table of known complexes from random starts, count successes");
  command
      .add_option("TABLE", options->table,
                  "CSV: name,unbound_interface_rmsd,fixed,moving,reference_fixed,reference_moving; "
                  "paths count from its folder")
      ->required();
  command
      .add_option("-o,--output", options->output,
                  "CSV of results, a row per pair as it is done; NAME_summary.csv beside it")
      ->required();
  command.add_option("--fold", options->fold, "Only every K-th pair, from the I-th on (I from 1)")
      ->type_name("I/K");
  command.add_option("--subset", options->subset, "Only the pairs of these names, by commas")
      ->delimiter(',');
  command.add_option("--seed", options->seed, "Seed of the random starts")->capture_default_str();
  command.add_option("--runs", options->runs, "Folder to keep each pair's run file in");
  command
      .add_option("--jobs", options->jobs,
                  "Pairs docked at a time; --threads is for each of them, 0 = its share of the "
                  "cores")
      ->capture_default_str()
      ->check(CLI::Range(1, 1024));
  command.add_flag("--png", options->png, "Draw the success curves too: NAME_success.png");
  command.add_flag("--force", options->force, "Replace results of other options");
  add_option_flags(command, dock_kind(), options->options);
  add_common_options(
      command, options->common,
      "  mortise benchmark pairs.csv -o results.csv\n"
      "  mortise benchmark pairs.csv -o fast.csv --preset fast --fold 1/5 --jobs 2 --threads 1\n"
      "  mortise benchmark pairs.csv -o few.csv --subset 1ACB,1A2K --runs runs/\n"
      "Pairs that are in the results already, with the same options, are not docked again; failed\n"
      "ones are. Two processes must not write to one file of results at the same time. Exit code "
      "1\n"
      "if a pair failed, after all others are done.");
  command.callback([options] { execute(*options); });
}

}  // namespace mortise::app
