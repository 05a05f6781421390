// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies of a run, found by path, by name or by contents, and read.
#include "mortise/report/bodies.hpp"

#include <algorithm>
#include <filesystem>
#include <vector>

#include "mortise/core/errors.hpp"
#include "mortise/molecules/radii.hpp"
#include "mortise/store/body.hpp"
#include "report/heavy_atoms.hpp"

namespace mortise {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kLargestSearched = 1'000'000'000;  // bytes
constexpr std::size_t kMostSearched = 100'000;              // files of a tree

// The file's SHA-256; empty for what is no file, too large, or not for us to read.
std::string sum_of(const fs::path& path) {
  std::error_code error;
  if (!fs::is_regular_file(path, error) || error) return {};
  const std::uintmax_t size = fs::file_size(path, error);
  if (error || size > kLargestSearched) return {};
  try {
    return sha256_of_file(path.string());
  } catch (const FileError&) {
    return {};
  }
}

// Files of this ending in a directory, or in all below it; sorted, so that every file system gives
// the same answer.
template <class Iterator>
std::vector<fs::path> files_of(const std::string& directory, const fs::path& ending) {
  std::vector<fs::path> entries;
  std::error_code error;
  std::size_t seen = 0;
  for (Iterator it(directory, fs::directory_options::skip_permission_denied, error), end;
       !error && it != end && seen < kMostSearched; it.increment(error), ++seen)
    if (it->path().extension() == ending) entries.push_back(it->path());
  std::sort(entries.begin(), entries.end());
  return entries;
}

struct Found {
  std::string path;   // empty: none
  std::string other;  // a file of the body's name with other contents
  std::string other_sum;
};

// A file of the recorded contents in the places.
Found search(const BodyRecord& body, const SearchPlaces& places) {
  const fs::path name = fs::path(body.path).filename();
  Found found;
  const auto is_it = [&](const fs::path& path) {
    const std::string sum = sum_of(path);
    if (sum == body.sha256) found.path = path.string();
    if (!sum.empty() && sum != body.sha256 && path.filename() == name && found.other.empty()) {
      found.other = path.string();
      found.other_sum = sum;
    }
    return sum == body.sha256;
  };
  for (const std::string& directory : places.directories)  // by its name first: no other is read
    if (is_it(fs::path(directory) / name)) return found;
  std::vector<std::vector<fs::path>> lists;
  for (const std::string& directory : places.directories)
    lists.push_back(files_of<fs::directory_iterator>(directory, name.extension()));
  for (const std::string& tree : places.trees) {
    lists.push_back(files_of<fs::recursive_directory_iterator>(tree, name.extension()));
    std::stable_partition(lists.back().begin(), lists.back().end(),
                          [&](const fs::path& path) { return path.filename() == name; });
  }
  for (const std::vector<fs::path>& list : lists)
    if (std::any_of(list.begin(), list.end(), is_it)) return found;
  return found;
}

// What the search did, for the error.
std::string search_text(const BodyRecord& body, const SearchPlaces& places, const Found& found) {
  std::string where;
  for (const std::string& directory : places.directories)
    where += (where.empty() ? "" : ", ") + directory;
  for (const std::string& tree : places.trees)
    where += (where.empty() ? "" : ", ") + tree + " and below";
  std::string text;
  if (!where.empty()) text = "; no file of SHA-256 " + body.sha256 + " in " + where;
  if (!found.other.empty())
    text += "; " + found.other + " has the name but SHA-256 " + found.other_sum;
  return text;
}

// Where the body's file is, with a notice if it moved.
std::string find_body(const BodyRecord& body, const Provenance& provenance, const std::string& name,
                      const LocateOptions& place, const SearchPlaces& places,
                      std::vector<std::string>& notices) {
  try {
    return locate_input(body, provenance, name, place);
  } catch (const FileError& e) {
    if (!place.path.empty() || body.sha256.empty()) throw;
    const Found found = search(body, places);
    if (found.path.empty()) {
      const std::string said = std::string(e.what()).substr(e.path().size() + 2);
      throw FileError(e.path(), said + search_text(body, places, found));
    }
    notices.push_back("The " + name + " input has moved since the run: " + body.path +
                      " was found by its SHA-256 at " + found.path + ".");
    return found.path;
  }
}

// Two molecules are shown as such; of any other pair both are surfaces.
ReportBody read_report_body(const BodyRecord& record, const Provenance& provenance,
                            const std::string& name, bool molecules, const std::string& found,
                            bool force) {
  const Body body = read_input_body(record, provenance, name, {found, force});
  ReportBody read;
  read.found = found;
  read.unit = body.record.unit;
  if (molecules)
    read.molecule = *body.molecule();
  else
    read.mesh = body_mesh(body);
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
  for (const std::string& tree : places.trees)
    if (std::error_code error; !fs::is_directory(tree, error))
      throw InputError(tree + ": expected a directory to search");
  ReportBodies bodies;
  const auto read = [&](const BodyRecord& record, const std::string& name,
                        const LocateOptions& place) {
    std::string found;
    try {
      found = find_body(record, run.provenance, name, place, places, bodies.notices);
    } catch (const InputError& e) {
      if (!places.allow_missing) throw;
      bodies.notices.push_back("Without structures: " + std::string(e.what()) + ".");
      ReportBody missing;
      missing.stand_in = record.knots.points.topRows<3>();
      return missing;
    }
    return read_report_body(record, run.provenance, name, of_molecules(run), found, place.force);
  };
  bodies.fixed = read(run.fixed, "fixed", places.fixed);
  bodies.moving = read(run.moving, "moving", places.moving);
  return bodies;
}

Eigen::Matrix3Xd report_points(const ReportBody& body) {
  if (body.is_missing()) return body.stand_in;
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
