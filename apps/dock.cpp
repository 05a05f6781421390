// SPDX-License-Identifier: GPL-3.0-or-later
// mortise dock: searches all placements of one molecule against another.
#include "mortise/runs/dock.hpp"

#include <cstdio>
#include <memory>

#include "commands.hpp"
#include "docking_job.hpp"
#include "search_command.hpp"

namespace mortise::app {
namespace {

struct DockFlags : SearchOptionsCommon {
  DockArguments arguments;
};

class DockCommand : public SearchCommand {
 public:
  explicit DockCommand(const DockFlags& options) : options_(options) {}

  [[nodiscard]] std::string name() const override { return "dock"; }
  [[nodiscard]] std::string label() const override { return "docking"; }
  [[nodiscard]] std::string unit() const override { return " A"; }

  [[nodiscard]] std::string file_of(const std::string& text) const override {
    return parse_molecule_spec(text).path;
  }

  void take_settings(const Run& earlier) override {
    settings_ = parse_settings(earlier.provenance.options_json);
    expect_same_settings(settings_json(settings_),
                         settings_json(resolve(options_.arguments, settings_)), "--resume");
  }

  [[nodiscard]] std::pair<std::string, std::uint64_t> make_settings() override {
    settings_ = resolve(options_.arguments);
    return {settings_json(settings_).dump(), settings_.random_start.value_or(0)};
  }

  void read(const Run* earlier) override {
    if (earlier != nullptr) {
      fixed_ = read_recorded_body(earlier->fixed, earlier->provenance, "fixed", options_.fixed,
                                  settings_.read);
      moving_ = read_recorded_body(earlier->moving, earlier->provenance, "moving", options_.moving,
                                   settings_.read);
    } else {
      fixed_ = read_dock_body(options_.fixed, settings_.read);
      moving_ = read_dock_body(options_.moving, settings_.read);
    }
  }

  [[nodiscard]] SearchResult search(const Provenance& provenance, const SearchWatch& watch,
                                    const Run* earlier) override {
    settings_.options.threads = options_.common.threads;
    return dock(fixed_, moving_, settings_, provenance, watch, earlier);
  }

  [[nodiscard]] std::vector<std::string> decisions() const override {
    std::vector<std::string> lines;
    for (const DockBody* body : {&fixed_, &moving_})
      for (const std::string& decision : body->decisions)
        lines.push_back(body->record.spec + ": " + decision);
    return lines;
  }

  void print_inputs() const override {
    for (const auto& [label, body] :
         {std::pair{"receptor", &fixed_}, std::pair{"ligand", &moving_}}) {
      std::printf("%-9s %s: %zu atoms\n", label, body->record.spec.c_str(),
                  body->molecule.atoms.size());
      for (const std::string& decision : body->decisions)
        std::printf("          %s\n", decision.c_str());
    }
    if (settings_.random_start)
      std::printf(
          "start     ligand moved at random by seed %llu; poses refer to the file as it is\n",
          static_cast<unsigned long long>(*settings_.random_start));
  }

  [[nodiscard]] std::string next_steps(const std::string& output) const override {
    return "  mortise export " + output + " --format pdb --top 10 --complex\n" +
           "  mortise evaluate " + output + " --reference-fixed FILE --reference-moving FILE\n";
  }

 private:
  const DockFlags& options_;
  DockSettings settings_;
  DockBody fixed_, moving_;
};

}  // namespace

void add_dock(CLI::App& program) {
  auto options = std::make_shared<DockFlags>();
  CLI::App& command = *program.add_subcommand(
      "dock", "Search all placements of one molecule against another, write ranked poses");
  command.add_option("FIXED", options->fixed,
                     "Receptor: PDB or mmCIF file, .gz too; FILE#MODEL:CHAIN,CHAIN for a part");
  command.add_option("MOVING", options->moving, "Ligand, likewise");
  command.add_option("-o,--output", options->output, "Run file to write (HDF5)")->required();
  add_dock_options(command, options->arguments);
  add_random_start(command, options->arguments,
                   "Move the ligand at random first, by this seed: for tests on complexes whose "
                   "ligand already sits right");
  add_search_flags(
      command, *options,
      "  mortise dock receptor.pdb ligand.pdb -o run.h5\n"
      "  mortise dock complex.cif.gz:A,B complex.cif.gz:C -o run.h5 --preset thorough\n"
      "  mortise dock receptor.pdb ligand.pdb -o run.h5 --rotations 54000 --json\n"
      "  mortise dock -o run.h5 --resume\n"
      "Ctrl-C saves the run so far, with the best poses of it (without, at a second Ctrl-C),\n"
      "and exits with 130.");
  command.callback([options] {
    DockCommand dock(*options);
    run_search_command(dock, *options);
  });
}

}  // namespace mortise::app
