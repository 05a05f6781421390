// SPDX-License-Identifier: GPL-3.0-or-later
// mortise report: one page that shows what a run has found, with its numbers and best poses as
// files.
#include <cstdio>
#include <filesystem>
#include <memory>

#include "commands.hpp"
#include "mortise/core/errors.hpp"
#include "mortise/report/write_report.hpp"

namespace mortise::app {
namespace {

namespace fs = std::filesystem;

struct ReportFlags {
  CommonOptions common;
  std::string run;
  std::string output;
  SearchPlaces places;
  ReportOptions report;
  bool force = false;
};

// "run.h5" becomes "run_report", beside the run.
std::string default_output(const std::string& run) {
  const fs::path path(run);
  return (path.parent_path() / (path.stem().string() + "_report")).string();
}

void execute(ReportFlags options) {
  const Run run = read_run(options.run);
  const std::string output = options.output.empty() ? default_output(options.run) : options.output;
  const fs::path beside = fs::path(options.run).parent_path();
  options.places.directories = {beside.empty() ? "." : beside.string(), "."};
  options.places.fixed.force = options.places.moving.force = options.force;
  options.report.threads = options.common.threads;
  const ReportBodies bodies = read_report_bodies(run, options.places);
  const ReportFiles result = write_report(run, bodies, output, options.report);
  if (!options.common.quiet) {
    for (const std::string& notice : bodies.notices)
      std::fprintf(stderr, "mortise: note: %s\n", notice.c_str());
    for (const std::string& warning : result.warnings)
      std::fprintf(stderr, "mortise: warning: %s\n", warning.c_str());
  }
  if (options.common.json)
    std::printf("%s\n", nlohmann::ordered_json{{"directory", output},
                                               {"files", result.files},
                                               {"poses", run.poses.poses.size()},
                                               {"warnings", result.warnings}}
                            .dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace)
                            .c_str());
  else if (!options.common.quiet)
    std::printf("wrote %zu files to %s; open %s\n", result.files.size(), output.c_str(),
                (fs::path(output) / result.files.front()).string().c_str());
}

}  // namespace

void add_report(CLI::App& program) {
  auto options = std::make_shared<ReportFlags>();
  CLI::App& command = *program.add_subcommand(
      "report", "Make a page that shows a run's ranked poses, and their files");
  command.add_option("run", options->run, "Run file")->required();
  command.add_option("-o,--output", options->output,
                     "Directory to write; default: RUN_report beside the run");
  command.add_option("--top", options->report.structures, "Best poses written as structure files")
      ->capture_default_str()
      ->check(CLI::NonNegativeNumber);
  command
      .add_option_function<std::string>(
          "--cluster",
          [options](const std::string& name) {
            options->report.clusters.measure = parse_cluster_measure(name);
          },
          "RMSD by which poses are one cluster: ligand, of the moving body with the fixed one in\n"
          "place; interface, of both bodies' interface, superposed  [ligand]")
      ->check(CLI::IsMember({"ligand", "interface"}))
      ->type_name("NAME");
  command
      .add_option_function<double>(
          "--cluster-radius",
          [options](double radius) { options->report.clusters.radius = radius; },
          "RMSD below which two poses are one cluster, length unit; 0 = the run's own clusters;\n"
          "default: by ligand those if one holds several poses, else a tenth of the moving body's\n"
          "diameter; by interface 3 A, or a twentieth of that diameter for parts")
      ->type_name("FLOAT");
  command
      .add_option("--min-cluster-size", options->report.clusters.min_size,
                  "Clusters of fewer poses are not listed; their poses stay")
      ->capture_default_str();
  command
      .add_option("--interfaces", options->report.interfaces,
                  "Best poses of molecules whose interface is described: area, contacts, hydrogen\n"
                  "bonds, clashes, Sc; where evaluate --interface has not done it")
      ->capture_default_str()
      ->check(CLI::NonNegativeNumber);
  command
      .add_option(
          "--page-triangles", options->report.part_triangles,
          "Triangles a part has at most on the page, about; larger ones are simplified, and the\n"
          "page says by how much")
      ->capture_default_str();
  command
      .add_option("--png", options->report.pictures,
                  "Best poses drawn as ray-traced PNG, with the plots: for papers")
      ->capture_default_str()
      ->check(CLI::NonNegativeNumber);
  command.add_option("--fixed", options->places.fixed.path, "Where the fixed body's file is now");
  command.add_option("--moving", options->places.moving.path,
                     "Where the moving body's file is now");
  command
      .add_option("--search", options->places.trees,
                  "Directories in which to look for inputs that moved, with all below them")
      ->type_name("DIR")
      ->expected(1)
      ->take_all();
  command.add_flag("--allow-missing", options->places.allow_missing,
                   "Make the report without structures whose files are not found");
  command.add_flag("--force", options->force, "Accept input files that have changed since the run");
  add_common_options(
      command, options->common,
      "  mortise report run.h5 -o report/\n"
      "  mortise report run.h5 --top 3 --png 3\n"
      "  mortise report run.h5 --cluster interface --cluster-radius 4 --min-cluster-size 3\n"
      "  mortise report run.h5 --search ~/structures --search /archive\n"
      "The page is index.html in that directory; it opens in any browser, without a\n"
      "network. Inputs that have moved are looked for, by SHA-256, beside the run and\n"
      "in the present directory.");
  command.callback([options] { execute(*options); });
}

}  // namespace mortise::app
