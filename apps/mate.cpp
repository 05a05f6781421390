// SPDX-License-Identifier: GPL-3.0-or-later
// mortise mate: finds how two mechanical parts fit together.
#include "mortise/runs/mate.hpp"

#include <cstdio>
#include <memory>

#include "commands.hpp"
#include "mating_job.hpp"
#include "search_command.hpp"

namespace mortise::app {
namespace {

struct MateFlags : SearchOptionsCommon {
  MateArguments arguments;
};

class MateCommand : public SearchCommand {
 public:
  explicit MateCommand(const MateFlags& options) : options_(options) {}

  [[nodiscard]] std::string name() const override { return "mate"; }
  [[nodiscard]] std::string label() const override { return "mating"; }
  [[nodiscard]] std::string unit() const override { return ""; }
  [[nodiscard]] std::string file_of(const std::string& text) const override { return text; }

  void take_settings(const Run& earlier) override {
    settings_ = parse_mate_settings(earlier.provenance.options_json);
    expect_same_settings(settings_json(settings_),
                         settings_json(resolve(options_.arguments, settings_)), "--resume");
  }

  [[nodiscard]] std::pair<std::string, std::uint64_t> make_settings() override {
    settings_ = resolve(options_.arguments);
    return {settings_json(settings_).dump(), settings_.random_start.value_or(0)};
  }

  void read(const Run* earlier) override {
    if (earlier != nullptr) {
      fixed_ = read_recorded_part(earlier->fixed, earlier->provenance, "fixed", options_.fixed,
                                  settings_);
      moving_ = read_recorded_part(earlier->moving, earlier->provenance, "moving", options_.moving,
                                   settings_);
    } else {
      fixed_ = read_mate_body(options_.fixed, settings_);
      moving_ = read_mate_body(options_.moving, settings_);
    }
    expect_one_unit(fixed_, moving_);
  }

  [[nodiscard]] SearchResult search(const Provenance& provenance, const SearchWatch& watch,
                                    const Run* earlier) override {
    settings_.options.threads = options_.common.threads;
    return mate(fixed_, moving_, settings_, provenance, watch, earlier);
  }

  [[nodiscard]] std::vector<std::string> decisions() const override {
    std::vector<std::string> lines;
    for (const MateBody* body : {&fixed_, &moving_})
      for (const std::string& decision : body->decisions)
        lines.push_back(body->record.spec + ": " + decision);
    return lines;
  }

  void print_inputs() const override {
    for (const auto& [label, body] : {std::pair{"fixed", &fixed_}, std::pair{"moving", &moving_}}) {
      std::printf("%-9s %s: %td triangles\n", label, body->record.spec.c_str(),
                  body->part.mesh.size());
      for (const std::string& decision : body->decisions)
        std::printf("          %s\n", decision.c_str());
    }
    if (settings_.random_start)
      std::printf("start     part moved at random by seed %llu; poses refer to the file as it is\n",
                  static_cast<unsigned long long>(*settings_.random_start));
  }

  [[nodiscard]] std::string next_steps(const std::string& output) const override {
    return "  mortise export " + output + " --format stl --pose 1 --complex\n" +
           "  mortise evaluate " + output + " --reference-pose FILE\n";
  }

 private:
  const MateFlags& options_;
  MateSettings settings_;
  MateBody fixed_, moving_;
};

}  // namespace

void add_mate(CLI::App& program) {
  auto options = std::make_shared<MateFlags>();
  CLI::App& command =
      *program.add_subcommand("mate", "Find how two parts fit together, write ranked placements");
  command.add_option("FIXED", options->fixed, "Fixed part: STL, OBJ, PLY, OFF or STEP file");
  command.add_option("MOVING", options->moving, "Moving part, likewise");
  command.add_option("-o,--output", options->output, "Run file to write (HDF5)")->required();
  add_mate_options(command, options->arguments);
  add_random_start(command, options->arguments,
                   "Move the moving part at random first, by this seed: for tests on parts that "
                   "already sit right");
  add_search_flags(
      command, *options,
      "  mortise mate block.step pin.step -o run.h5\n"
      "  mortise mate seat.obj leg.obj -o run.h5 --preset thorough\n"
      "  mortise mate block.stl pin.stl -o run.h5 --axis 0,0,1:0,0,1 --rotations 360\n"
      "  mortise mate -o run.h5 --resume\n"
      "Score: facing surfaces in contact less what penetrates, relative to the smaller surface.\n"
      "Ctrl-C saves the run so far, with the best placements of it (without, at a second Ctrl-C),\n"
      "and exits with 130.");
  command.callback([options] {
    MateCommand mate(*options);
    run_search_command(mate, *options);
  });
}

}  // namespace mortise::app
