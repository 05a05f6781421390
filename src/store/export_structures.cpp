// SPDX-License-Identifier: GPL-3.0-or-later
// Poses as multi-model PDB and mmCIF files.
#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>

#include "mortise/core/errors.hpp"
#include "mortise/molecules/write_molecule.hpp"
#include "mortise/store/export.hpp"

namespace mortise {
namespace {

void expect_molecules(const Run& run, const char* format, const ExportOptions& options) {
  for (const auto& [record, name] :
       {std::pair{&run.moving, "moving"}, std::pair{&run.fixed, "fixed"}})
    if ((record == &run.moving || options.complex) && record->kind != "molecule")
      throw InputError(std::string("format ") + format + " is for molecules; the " + name +
                       " body of this " + run.kind + " run is " +
                       (record->kind == "part" ? "a part" : record->kind));
}

// What a reader should know of the file, one line each, for REMARKs or comments.
std::vector<std::string> describe(const Run& run, const Molecule& given, const Molecule& written,
                                  const std::vector<std::size_t>& poses,
                                  const ExportOptions& options) {
  const auto file_name = [](const BodyRecord& body) {
    return std::filesystem::path(body.spec).filename().string();
  };
  std::vector<std::string> lines = {
      "Mortise " + run.provenance.mortise_version + ", " + run.provenance.utc_time,
      "fixed: " + file_name(run.fixed),
      "moving: " + file_name(run.moving) + (options.complex ? "" : ", alone here")};
  std::vector<std::string> told;
  for (std::size_t i = 0; i < given.atoms.size(); ++i) {
    const std::string& old_name = given.atoms[i].chain;
    if (old_name == written.atoms[i].chain || std::count(told.begin(), told.end(), old_name) > 0)
      continue;
    told.push_back(old_name);
    lines.push_back("moving chain " + (old_name.empty() ? "without a name" : old_name) +
                    " is written as " + written.atoms[i].chain);
  }
  for (const std::size_t i : poses) {
    std::array<char, 80> line;
    std::snprintf(line.data(), line.size(), "model %zu: rank %zu, score %.6g", i + 1, i + 1,
                  run.poses.poses[i].score);
    lines.emplace_back(line.data());
  }
  for (std::string& line : lines)
    for (char& c : line)
      if (static_cast<unsigned char>(c) < ' ') c = ' ';
  return lines;
}

int count_lines(const std::string& text) {
  return static_cast<int>(std::count(text.begin(), text.end(), '\n'));
}

}  // namespace

std::string export_pdb(const Run& run, const Molecule& fixed, const Molecule& moving,
                       const ExportOptions& options) {
  expect_molecules(run, "pdb", options);
  const std::vector<std::size_t> poses = chosen_poses(run, ExportFormat::kPdb, options);
  const Molecule written = options.complex ? with_distinct_chains(moving, fixed) : moving;
  std::string text;
  for (const std::string& line : describe(run, moving, written, poses, options))
    text += ("REMARK   6 " + line).substr(0, 80) + "\n";  // 6 to 99: free text [PDB format 2.3]
  const std::string fixed_atoms = options.complex ? format_pdb_atoms(fixed) : "";
  for (const std::size_t i : poses) {
    const std::string moved = format_pdb_atoms(written, run.poses.poses[i].moving_in_fixed,
                                               {.first_serial = count_lines(fixed_atoms) + 1});
    text += format_pdb_model(static_cast<int>(i) + 1, fixed_atoms + moved);
  }
  return text + "END\n";
}

std::string export_mmcif(const Run& run, const Molecule& fixed, const Molecule& moving,
                         const ExportOptions& options) {
  expect_molecules(run, "cif", options);
  const std::vector<std::size_t> poses = chosen_poses(run, ExportFormat::kMmcif, options);
  const Molecule written = options.complex ? with_distinct_chains(moving, fixed) : moving;
  std::string text;
  for (const std::string& line : describe(run, moving, written, poses, options))
    text += "# " + line + "\n";
  text += format_mmcif_head("mortise_poses");
  int serial = 1;  // unique over all models, as the format asks
  for (const std::size_t i : poses) {
    const int model = static_cast<int>(i) + 1;
    if (options.complex) {
      text += format_mmcif_atoms(fixed, {}, {.first_serial = serial, .model = model});
      serial += static_cast<int>(fixed.atoms.size());
    }
    text += format_mmcif_atoms(written, run.poses.poses[i].moving_in_fixed,
                               {.first_serial = serial, .model = model});
    serial += static_cast<int>(written.atoms.size());
  }
  return text + "#\n";
}

}  // namespace mortise
