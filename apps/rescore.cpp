// SPDX-License-Identifier: GPL-3.0-or-later
// mortise rescore: ranks a run's candidates anew, without a search.
#include <cstdio>
#include <memory>
#include <utility>
#include <vector>

#include "clearances.hpp"
#include "clock.hpp"
#include "commands.hpp"
#include "interrupt.hpp"
#include "mortise/core/errors.hpp"
#include "option_flags.hpp"
#include "output_guard.hpp"
#include "pose_table.hpp"

namespace mortise::app {
namespace {

struct RescoreFlags {
  CommonOptions common;
  std::string run, output;
  InputPlaces places;
  std::vector<std::pair<std::string, std::string>> changes;  // option, value
  bool force = false;
};

// The run's own options with the user's over them.
template <class Options>
std::string changed_options(const RunKind<Options>& kind, const Run& run,
                            const RescoreFlags& flags) {
  Options options = kind.parse(run.provenance.options_json);
  for (const auto& [name, text] : flags.changes) set_option(options, name, text);
  return kind.to_json(options);
}

void execute(const RescoreFlags& flags) {
  exit_at_once_on_interrupt("nothing was written");
  const auto begin = Clock::now();
  const Run run = read_run(flags.run);
  check_output_file(flags.output,
                    {flags.run, run.fixed.path, run.moving.path, flags.places.fixed.path,
                     flags.places.moving.path},
                    flags.force, "--force replaces it");
  const std::string options = run.kind == mate_kind().name
                                  ? changed_options(mate_kind(), run, flags)
                                  : changed_options(dock_kind(), run, flags);
  const SearchPlan plan = plan_again(run, options, flags.places, flags.common.threads);
  Run result = rescore(run, plan);
  result.provenance =
      make_provenance(command_line(), result.provenance.options_json, run.provenance.seed);
  write_run(flags.output, result);
  const double seconds = seconds_since(begin);
  if (flags.common.json) {
    nlohmann::ordered_json json = {{"candidates", run.candidates.size()},
                                   {"poses", result.poses.poses.size()},
                                   {"seconds", seconds},
                                   {"best_score", nullptr},
                                   {"file", flags.output},
                                   {"complete", result.complete}};
    if (!result.poses.poses.empty()) json["best_score"] = result.poses.poses.front().score;
    add_clearances(json, result);
    std::printf("%s\n", json.dump().c_str());
  } else if (!flags.common.quiet) {
    std::printf("ranked    %zu candidates to %zu poses in %.1f s\n%s\n%s\nwrote %s\n",
                run.candidates.size(), result.poses.poses.size(), seconds,
                clearance_lines(result).c_str(), pose_table(result, 10).c_str(),
                flags.output.c_str());
  }
}

// Every option of ranking, once: a name that both kinds have means the run's own.
template <class Options>
void add_ranking_options(CLI::App& command, const RunKind<Options>& kind, const char* of,
                         RescoreFlags& flags) {
  for (const OptionRow<Options>& row : kind.rows()) {
    const std::string flag = flag_of(row.name);
    if (row.scope != OptionScope::kRanking || command.get_option_no_throw(flag) != nullptr)
      continue;
    const auto set = [&flags, name = std::string(row.name)](const std::string& text) {
      flags.changes.emplace_back(name, text);
    };
    if (std::holds_alternative<typename OptionRow<Options>::Switch>(row.field))
      command
          .add_flag_function(
              flag + ",!--no-" + flag.substr(2),
              [set](std::int64_t count) { set(count > 0 ? "on" : "off"); }, row.help)
          ->group(of);
    else
      command.add_option_function<std::string>(flag, set, row.help)->group(of);
  }
}

}  // namespace

void add_rescore(CLI::App& program) {
  auto flags = std::make_shared<RescoreFlags>();
  CLI::App& command = *program.add_subcommand(
      "rescore", "Rank a run's candidates anew with other options, without searching");
  command.add_option("run", flags->run, "Run file of dock or mate")->required();
  command.add_option("-o,--output", flags->output, "Run file to write")->required();
  command.add_option("--fixed", flags->places.fixed.path, "Where the fixed body's file is now");
  command.add_option("--moving", flags->places.moving.path, "Where the moving body's file is now");
  command.add_flag("--force", flags->force, "Replace the output if it is there");
  add_ranking_options(command, dock_kind(), "Ranking (what is not given stays as in the run)",
                      *flags);
  add_ranking_options(command, mate_kind(), "Ranking of parts", *flags);
  add_common_options(command, flags->common,
                     "  mortise rescore run.h5 -o shape.h5 --no-rescore\n"
                     "  mortise rescore run.h5 -o other.h5 --potential contacts.txt --poses 500\n"
                     "  mortise rescore mate.h5 -o strict.h5 --penetration-weight 6\n"
                     "Options of the search cannot change. Metrics that evaluate added are left "
                     "out.");
  command.callback([flags] { execute(*flags); });
}

}  // namespace mortise::app
