// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies of a run, found by path, by name or by contents, and read.
#include "mortise/report/bodies.hpp"

#include <algorithm>
#include <filesystem>
#include <vector>

#include "mortise/core/errors.hpp"
#include "mortise/molecules/radii.hpp"
#include "report/heavy_atoms.hpp"

namespace mortise {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kLargestSearched = 256'000'000;  // bytes

bool has_sum(const fs::path& path, const std::string& sha256) {
  std::error_code error;
  if (!fs::is_regular_file(path, error) || error) return false;
  const std::uintmax_t size = fs::file_size(path, error);
  if (error || size > kLargestSearched) return false;
  try {
    return sha256_of_file(path.string()) == sha256;
  } catch (const FileError&) {
    return false;  // not for us to read
  }
}

// A file of the recorded contents in one of the directories; empty if there is none.
std::string search_directories(const BodyRecord& body,
                               const std::vector<std::string>& directories) {
  const fs::path name = fs::path(body.path).filename();
  for (const std::string& directory : directories)
    if (has_sum(fs::path(directory) / name, body.sha256))
      return (fs::path(directory) / name).string();
  for (const std::string& directory : directories) {
    std::vector<fs::path> entries;
    std::error_code error;
    for (fs::directory_iterator it(directory, error), end; !error && it != end; it.increment(error))
      if (it->path().extension() == name.extension()) entries.push_back(it->path());
    std::sort(entries.begin(), entries.end());  // the same answer on every file system
    for (const fs::path& entry : entries)
      if (has_sum(entry, body.sha256)) return entry.string();
  }
  return {};
}

// Where the body's file is, with a notice if it moved.
std::string find_body(const BodyRecord& body, const Provenance& provenance, const std::string& name,
                      const LocateOptions& place, const std::vector<std::string>& directories,
                      std::vector<std::string>& notices) {
  try {
    return locate_input(body, provenance, name, place);
  } catch (const FileError&) {
    if (!place.path.empty() || body.sha256.empty()) throw;
    std::string found = search_directories(body, directories);
    if (found.empty()) throw;
    notices.push_back("The " + name + " input has moved since the run: " + body.path +
                      " was found by its SHA-256 at " + found + ".");
    return found;
  }
}

ReportBody read_body(const BodyRecord& body, const Provenance& provenance, const std::string& name,
                     const std::string& kind, const std::string& found, bool force) {
  ReportBody read;
  read.found = found;
  if (kind == "mate") {
    ReadPartResult part = read_input_part(body, provenance, name, {found, force});
    read.mesh = std::move(part.mesh);
    read.unit = part.unit;
  } else if (kind == "dock") {
    read.molecule = read_input_molecule(body, provenance, name, {found, force});
    read.unit = "angstrom";
  } else {
    throw InputError("report: expected a docking or a mating run, got a " + kind + " run");
  }
  return read;
}

}  // namespace

Molecule detail::heavy_atoms(const Molecule& molecule) {
  Molecule heavy;
  heavy.path = molecule.path;
  for (const Atom& atom : molecule.atoms)
    if (atom.element != "H" && atom.element != "D") heavy.atoms.push_back(atom);
  return heavy;
}

ReportBodies read_report_bodies(const Run& run, const SearchPlaces& places) {
  ReportBodies bodies;
  const auto read = [&](const BodyRecord& record, const std::string& name,
                        const LocateOptions& place) {
    const std::string found =
        find_body(record, run.provenance, name, place, places.directories, bodies.notices);
    return read_body(record, run.provenance, name, run.kind, found, place.force);
  };
  bodies.fixed = read(run.fixed, "fixed", places.fixed);
  bodies.moving = read(run.moving, "moving", places.moving);
  return bodies;
}

Eigen::Matrix3Xd report_points(const ReportBody& body) {
  if (!body.is_mesh()) return atom_positions(detail::heavy_atoms(body.molecule));
  std::vector<char> used(static_cast<std::size_t>(body.mesh.vertices.cols()), 0);
  for (const int corner : body.mesh.triangles.reshaped())
    used[static_cast<std::size_t>(corner)] = 1;
  Eigen::Matrix3Xd points(3, std::count(used.begin(), used.end(), 1));
  Eigen::Index next = 0;
  for (std::size_t i = 0; i < used.size(); ++i)
    if (used[i] != 0) points.col(next++) = body.mesh.vertices.col(static_cast<Eigen::Index>(i));
  return points;
}

}  // namespace mortise
