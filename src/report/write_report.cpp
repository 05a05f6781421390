// SPDX-License-Identifier: GPL-3.0-or-later
// All files of a report.
#include "mortise/report/write_report.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>

#include "mortise/core/errors.hpp"
#include "mortise/core/version.hpp"
#include "mortise/molecules/write_molecule.hpp"
#include "mortise/parts/format_part.hpp"
#include "mortise/report/page.hpp"
#include "mortise/report/pictures.hpp"
#include "mortise/report/viewer_scripts.hpp"
#include "mortise/store/atomic_file.hpp"
#include "mortise/store/export.hpp"
#include "report/page_mesh.hpp"

namespace mortise {
namespace {

namespace fs = std::filesystem;

void make_directory(const fs::path& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error || !fs::is_directory(path))
    throw FileError(path.string(), "expected a directory to write a report into" +
                                       (error ? ": " + error.message() : std::string()));
}

std::string pose_file_name(std::size_t rank, const std::string& ending) {
  std::array<char, 32> name;
  std::snprintf(name.data(), name.size(), "pose_%04zu.", rank);
  return name.data() + ending;
}

// A table of no poses: its head alone.
std::string csv_of(const Run& run) {
  if (!run.poses.poses.empty()) return export_csv(run);
  return "rank,score,qw,qx,qy,qz,tx,ty,tz,rotation_index,cluster\n";
}

std::string json_of(const Run& run) {
  if (!run.poses.poses.empty()) return export_json(run);
  return "{\"poses\": []}\n";
}

// Both bodies as PDB or, where one has no room in it, both as mmCIF; parts as STL.
struct StructureText {
  std::string ending;
  std::string fixed;
  std::vector<std::string> poses;
};

StructureText structure_texts(const Run& run, const ReportBodies& bodies, std::size_t count) {
  StructureText text;
  if (bodies.fixed.is_mesh()) {
    text = {"stl", format_stl(bodies.fixed.mesh), {}};
    for (std::size_t i = 0; i < count; ++i)
      text.poses.push_back(format_stl(bodies.moving.mesh, run.poses.poses[i].moving_in_fixed));
    return text;
  }
  const Molecule& moving = bodies.moving.molecule;
  try {
    text.ending = "pdb";
    text.fixed = format_pdb_atoms(bodies.fixed.molecule) + "END\n";
    for (std::size_t i = 0; i < count; ++i)
      text.poses.push_back(format_pdb_atoms(moving, run.poses.poses[i].moving_in_fixed) + "END\n");
  } catch (const InputError&) {
    text = {"cif", format_mmcif_head("fixed") + format_mmcif_atoms(bodies.fixed.molecule), {}};
    for (std::size_t i = 0; i < count; ++i)
      text.poses.push_back(format_mmcif_head("pose_" + std::to_string(i + 1)) +
                           format_mmcif_atoms(moving, run.poses.poses[i].moving_in_fixed));
  }
  return text;
}

class Writer {
 public:
  explicit Writer(fs::path directory) : directory_(std::move(directory)) {
    make_directory(directory_);
  }

  void write(const std::string& name, std::string_view text) {
    write_file_atomically((directory_ / name).string(), text);
    result_.files.push_back(name);
  }
  void note(const std::string& name) { result_.files.push_back(name); }
  void warn(const std::string& text) { result_.warnings.push_back(text); }
  [[nodiscard]] const fs::path& directory() const { return directory_; }
  [[nodiscard]] ReportFiles take() { return std::move(result_); }

 private:
  fs::path directory_;
  ReportFiles result_;
};

bool without_structures(const ReportBodies& bodies) {
  return bodies.fixed.is_missing() || bodies.moving.is_missing();
}

// Pictures are extras: where a program for them is missing, the report says so and goes on.
void write_pictures(Writer& writer, const Run& run, const ReportBodies& bodies,
                    const ReportOptions& options) {
  const std::size_t count =
      std::min(static_cast<std::size_t>(options.pictures), run.poses.poses.size());
  if (count == 0) return;
  make_directory(writer.directory() / "poses");
  try {
    for (const std::string& name : draw_plots(run, writer.directory().string())) writer.note(name);
  } catch (const InputError& e) {
    writer.warn(std::string("no plots: ") + e.what());
  }
  if (without_structures(bodies)) return;
  try {
    constexpr Eigen::Index kDrawn = 200'000;  // triangles: a pixel or so each
    ReportBodies drawn = bodies;
    drawn.fixed.mesh = detail::simplified(bodies.fixed.mesh, kDrawn).mesh;
    drawn.moving.mesh = detail::simplified(bodies.moving.mesh, kDrawn).mesh;
    const PictureOptions picture = {.threads = options.threads};
    for (std::size_t i = 0; i < count; ++i) {
      const std::string name = "poses/" + pose_file_name(i + 1, "png");
      render_scene(povray_scene(drawn, run.poses.poses[i].moving_in_fixed, picture),
                   (writer.directory() / name).string(), picture);
      writer.note(name);
    }
  } catch (const InputError& e) {
    writer.warn(std::string("no pictures of poses: ") + e.what());
  }
}

void write_structures(Writer& writer, const Run& run, const ReportBodies& bodies, int structures) {
  const std::size_t count = std::min(static_cast<std::size_t>(structures), run.poses.poses.size());
  if (count == 0) return;
  if (without_structures(bodies)) {
    writer.warn("no structure files: an input file was not found");
    return;
  }
  make_directory(writer.directory() / "poses");
  const StructureText text = structure_texts(run, bodies, count);
  ViewerFiles files;
  files.meshes = bodies.fixed.is_mesh();
  files.fixed = "poses/fixed." + text.ending;
  writer.write(files.fixed, text.fixed);
  for (std::size_t i = 0; i < count; ++i) {
    files.poses.push_back("poses/" + pose_file_name(i + 1, text.ending));
    writer.write(files.poses.back(), text.poses[i]);
  }
  writer.write("poses.pml", pymol_script(files));
  writer.write("poses.cxc", chimerax_script(files));
}

std::vector<std::string> notices_of(const Run& run, const Run& shown) {
  std::vector<std::string> notices;
  const auto done = std::count(run.rotations.done.begin(), run.rotations.done.end(), 1);
  if (!run.complete) {
    std::string text = "This search is not finished: " + std::to_string(done) + " of " +
                       std::to_string(run.rotations.done.size()) + " rotations are done.";
    if (run.poses.poses.empty() && !shown.poses.poses.empty())
      text += " The poses are its best raw candidates so far, neither rescored nor thinned out.";
    notices.push_back(text + " mortise " + run.kind + " --resume finishes it.");
  }
  if (run.provenance.mortise_version != kVersion)
    notices.push_back("The run was made by Mortise " + run.provenance.mortise_version +
                      ", this page by " + kVersion + ".");
  return notices;
}

}  // namespace

ReportFiles write_report(const Run& run, const ReportBodies& bodies, const std::string& directory,
                         const ReportOptions& options) {
  const PreparedReport prepared = prepare_report(run, bodies, options);
  const Run& shown = prepared.run;
  ReportBodies told = bodies;
  const std::vector<std::string> notices = notices_of(run, shown);
  told.notices.insert(told.notices.begin(), notices.begin(), notices.end());

  Writer writer(directory);
  if (report_page_available())
    writer.write("index.html", report_page(shown, told,
                                           {.clusters = prepared.clusters,
                                            .part_triangles = options.part_triangles,
                                            .threads = options.threads}));
  else
    writer.warn("no index.html: this build was configured with MORTISE_REPORT=OFF");
  writer.write("poses.csv", csv_of(shown));
  writer.write("poses.json", json_of(shown));
  writer.write("clusters.csv", clusters_csv(shown, prepared.clusters));
  writer.write("clusters.json", clusters_json(shown, prepared.clusters));
  write_structures(writer, shown, bodies, options.structures);
  write_pictures(writer, shown, bodies, options);
  return writer.take();
}

}  // namespace mortise
