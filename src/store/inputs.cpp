// SPDX-License-Identifier: GPL-3.0-or-later
// Input files by recorded path and checksum.
#include "mortise/store/inputs.hpp"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

#include "mortise/core/errors.hpp"
#include "mortise/molecules/read_molecule.hpp"

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

Molecule read_input_molecule(const BodyRecord& body, const Provenance& provenance,
                             const std::string& name, const LocateOptions& options) {
  const std::string path = locate_input(body, provenance, name, options);
  MoleculeSpec spec;
  if (body.spec.compare(0, body.path.size(), body.path) == 0)
    // The suffix says model and chains; its own file name is spared from being looked up where it
    // no longer is.
    spec = parse_molecule_spec("mortise-input.pdb" + body.spec.substr(body.path.size()));
  else
    spec = parse_molecule_spec(body.spec);
  spec.path = path;
  return read_molecule(spec, {.keep_hydrogens = true}).molecule;
}

ReadPartResult read_input_part(const BodyRecord& body, const Provenance& provenance,
                               const std::string& name, const LocateOptions& options) {
  // What a run could use can be used again, whatever else a later program knows of its options.
  ReadPartOptions read{.repair = {.allow_open = true, .find_self_intersections = false}};
  const nlohmann::json recorded =
      nlohmann::json::parse(provenance.options_json, nullptr, /*allow_exceptions=*/false);
  if (recorded.is_object() && recorded.contains("deviation") && recorded["deviation"].is_number())
    read.absolute_deviation = recorded["deviation"].get<double>();
  return read_part(locate_input(body, provenance, name, options), read);
}

}  // namespace mortise
