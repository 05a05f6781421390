// SPDX-License-Identifier: GPL-3.0-or-later
// mortise export: a run's poses as PDB, mmCIF, CSV, JSON or ZDOCK .out, or as placed parts.
#include "mortise/store/export.hpp"

#include <cstdio>
#include <filesystem>
#include <memory>

#include "commands.hpp"
#include "mortise/core/errors.hpp"
#include "mortise/store/atomic_file.hpp"
#include "mortise/store/body.hpp"
#include "mortise/store/inputs.hpp"
#include "output_guard.hpp"

namespace mortise::app {
namespace {

namespace fs = std::filesystem;

struct ExportFlags {
  CommonOptions common;
  std::string run;
  std::string format;
  std::string output;
  ExportOptions choice;
  std::string fixed_path;
  std::string moving_path;
  bool force = false;
};

// "run.h5" and "cif" become "run_poses.cif": beside the run, and never the name of an input.
std::string default_output(const std::string& run, const std::string& format) {
  const fs::path path(run);
  return (path.parent_path() /
          (path.stem().string() + "_poses." + (format == "zdock" ? "out" : format)))
      .string();
}

bool is_for_parts(ExportFormat format) {
  return format == ExportFormat::kStl || format == ExportFormat::kPly ||
         format == ExportFormat::kStep;
}

// "x.stl" becomes "x_3.stl".
std::string with_rank(const std::string& path, std::size_t rank) {
  const fs::path p(path);
  return (p.parent_path() /
          (p.stem().string() + "_" + std::to_string(rank) + p.extension().string()))
      .string();
}

// A file of parts holds one placement: several go to several files.
std::vector<std::string> files_of_parts(const Run& run, ExportFormat format,
                                        const ExportFlags& options, const std::string& output) {
  const std::vector<std::size_t> poses = chosen_poses(run, format, options.choice);
  if (poses.size() == 1) return {output};
  if (output == "-")
    throw InputError("export: stdout takes one placement of parts; choose it by --pose");
  std::vector<std::string> files;
  files.reserve(poses.size());
  for (const std::size_t i : poses) files.push_back(with_rank(output, i + 1));
  return files;
}

// Writes one file for each placement; gives the text where `files` is stdout's "-".
std::string export_parts(const Run& run, ExportFormat format, const ExportFlags& options,
                         const std::vector<std::string>& files) {
  const ExportParts parts = read_export_parts(run, {options.fixed_path, options.force},
                                              {options.moving_path, options.force}, options.choice);
  const std::vector<std::size_t> poses = chosen_poses(run, format, options.choice);
  for (std::size_t n = 0; n < poses.size(); ++n) {
    std::string text = export_part(run, format, poses[n], parts, options.choice);
    if (files[n] == "-") return text;
    write_file_atomically(files[n], text);
  }
  return {};
}

std::string export_text(const Run& run, ExportFormat format, const ExportFlags& options) {
  switch (format) {
    case ExportFormat::kCsv:
      return export_csv(run, options.choice);
    case ExportFormat::kJson:
      return export_json(run, options.choice);
    case ExportFormat::kZdock: {
      (void)locate_input(run.fixed, run.provenance, "fixed", {options.fixed_path, options.force});
      (void)locate_input(run.moving, run.provenance, "moving",
                         {options.moving_path, options.force});
      Run named = run;  // the header should name the files as they are found now
      if (!options.fixed_path.empty()) named.fixed.path = options.fixed_path;
      if (!options.moving_path.empty()) named.moving.path = options.moving_path;
      return export_zdock(named, options.choice);
    }
    default:
      break;
  }
  (void)chosen_poses(run, format, options.choice);  // fail before the molecules are read
  // What is no molecule is refused below, by name.
  const auto molecule = [&](const BodyRecord& record, const char* name, const std::string& path) {
    return record.kind == "molecule"
               ? *read_input_body(record, run.provenance, name, {path, options.force}).molecule()
               : Molecule();
  };
  Molecule fixed;
  if (options.choice.complex) fixed = molecule(run.fixed, "fixed", options.fixed_path);
  const Molecule moving = molecule(run.moving, "moving", options.moving_path);
  return format == ExportFormat::kPdb ? export_pdb(run, fixed, moving, options.choice)
                                      : export_mmcif(run, fixed, moving, options.choice);
}

// All that a run's two inputs may be called.
std::vector<std::string> inputs_of(const Run& run, const ExportFlags& options) {
  const fs::path directory(run.provenance.working_directory);
  return {options.run,
          run.fixed.path,
          run.moving.path,
          options.fixed_path,
          options.moving_path,
          (directory / run.fixed.path).string(),
          (directory / run.moving.path).string()};
}

void execute(const ExportFlags& options) {
  const ExportFormat format = parse_export_format(options.format);
  const bool to_stdout = options.output == "-";
  if (to_stdout && options.common.json)
    throw InputError("export: --json and -o - both want stdout; choose one");
  const Run run = read_run(options.run);
  const std::string output =
      options.output.empty() ? default_output(options.run, options.format) : options.output;
  std::vector<std::string> files{output};
  if (is_for_parts(format)) files = files_of_parts(run, format, options, output);
  if (!to_stdout)
    for (const std::string& file : files) {
      refuse_to_overwrite_input(file, inputs_of(run, options));
      check_writable(file, 0);
    }
  const std::string text = is_for_parts(format) ? export_parts(run, format, options, files)
                                                : export_text(run, format, options);
  if (to_stdout) {
    if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0)
      throw InputError("export: writing to stdout failed");
    return;
  }
  if (!is_for_parts(format)) write_file_atomically(output, text);
  const std::size_t count = chosen_poses(run, format, options.choice).size();
  if (options.common.json) {
    nlohmann::ordered_json json{
        {"file", files.front()}, {"format", options.format}, {"poses", count}};
    if (files.size() > 1) json["files"] = files;
    std::printf("%s\n", json.dump().c_str());
  } else if (!options.common.quiet) {
    std::printf("wrote %zu %s to %s%s\n", count, count == 1 ? "pose" : "poses",
                files.front().c_str(), files.size() > 1 ? (" ... " + files.back()).c_str() : "");
  }
}

}  // namespace

void add_export(CLI::App& program) {
  auto options = std::make_shared<ExportFlags>();
  CLI::App& command = *program.add_subcommand(
      "export", "Write a run's poses as PDB, mmCIF, CSV, JSON, ZDOCK .out, or as placed parts");
  command.add_option("run", options->run, "Run file")->required();
  command
      .add_option("--format", options->format,
                  "pdb, cif, csv, json or zdock; for parts stl, ply, step, csv or json")
      ->required();
  command
      .add_option(
          "--top", options->choice.top,
          "Poses to write, from the best; 0 = 10 for pdb and cif, 1 for parts, all otherwise")
      ->capture_default_str()
      ->check(CLI::NonNegativeNumber);
  command.add_option("--pose", options->choice.pose, "Only the pose of this rank, from 1")
      ->check(CLI::PositiveNumber)
      ->excludes("--top");
  command.add_flag("--complex", options->choice.complex,
                   "pdb, cif, stl, ply, step: the fixed body too, in every model");
  command.add_option("-o,--output", options->output,
                     "File to write; - = stdout; default: RUN_poses.FORMAT beside the run");
  command.add_option("--fixed", options->fixed_path, "Where the receptor's file is now");
  command.add_option("--moving", options->moving_path, "Where the ligand's file is now");
  command.add_flag("--force", options->force, "Accept input files that have changed since the run");
  add_common_options(command, options->common,
                     "  mortise export run.h5 --format pdb --top 10 --complex\n"
                     "  mortise export mate.h5 --format stl --pose 1 --complex\n"
                     "  mortise export run.h5 --format csv -o - | head\n"
                     "  mortise export run.h5 --format zdock --top 2000 -o run.out");
  command.callback([options] { execute(*options); });
}

}  // namespace mortise::app
