// SPDX-License-Identifier: GPL-3.0-or-later
// Input files by recorded path and checksum.
#include "mortise/store/inputs.hpp"

#include <filesystem>
#include <vector>

#include "mortise/core/errors.hpp"

namespace mortise {

std::string locate_input(const BodyRecord& body, const Provenance& provenance,
                         const std::string& name, const LocateOptions& options) {
  namespace fs = std::filesystem;
  std::vector<fs::path> places;
  if (!options.path.empty()) {
    places.emplace_back(options.path);
  } else {
    if (body.path.empty()) throw InputError("the run does not say where its " + name + " input is");
    places.push_back(fs::path(provenance.working_directory) /
                     body.path);  // an absolute path stays as it is
    if (fs::path(body.path).is_relative()) places.emplace_back(body.path);
  }
  std::string changed, changed_sum;
  for (const fs::path& place : places) {
    std::error_code error;
    if (!fs::is_regular_file(place, error)) continue;
    if (options.force || body.sha256.empty()) return place.string();
    const std::string sum = sha256_of_file(place.string());
    if (sum == body.sha256) return place.string();
    if (changed.empty()) {
      changed = place.string();
      changed_sum = sum;
    }
  }
  if (!changed.empty())
    throw FileError(changed, "the run's " + name + " input has changed: expected SHA-256 " +
                                 body.sha256.substr(0, 12) + "..., found " +
                                 changed_sum.substr(0, 12) + "... (--force accepts it)");
  throw FileError(places.front().string(), "the run's " + name + " input is not there (--" + name +
                                               " PATH says where it is now)");
}

}  // namespace mortise
