// SPDX-License-Identifier: GPL-3.0-or-later
// Provenance, knots and figures in HDF5.
#include "store/records.hpp"

#include <algorithm>

#include "mortise/core/errors.hpp"

namespace mortise::hdf5 {

void write_head(Writer& file, const std::string& kind, int format_version,
                const Provenance& provenance) {
  file.attribute("/", "mortise_file", kind);
  file.attribute("/", "format_version", std::int64_t{format_version});
  file.attribute("/", "mortise_version", provenance.mortise_version);
  file.attribute("/", "command_line", provenance.command_line);
  file.attribute("/", "working_directory", provenance.working_directory);
  file.attribute("/", "options", provenance.options_json);
  file.attribute("/", "seed", provenance.seed);
  file.attribute("/", "utc_time", provenance.utc_time);
  file.attribute("/", "host", provenance.host);
}

Provenance read_head(const Reader& file, const std::string& kind, int format_version) {
  if (!file.has_attribute("/", "mortise_file"))
    file.fail("an HDF5 file, but not one of Mortise's: expected a " + kind + " file");
  if (const std::string found = file.text("/", "mortise_file"); found != kind)
    file.fail("expected a " + kind + " file, found a " + found + " file");
  if (const std::int64_t found = file.integer("/", "format_version"); found != format_version)
    file.fail(
        "expected format version " + std::to_string(format_version) + " of the " + kind +
        " file, found " + std::to_string(found) + ", written by Mortise " +
        (file.has_attribute("/", "mortise_version") ? file.text("/", "mortise_version") : "?"));
  Provenance p;
  p.mortise_version = file.text("/", "mortise_version");
  p.command_line = file.text("/", "command_line");
  p.working_directory = file.text("/", "working_directory");
  p.options_json = file.text("/", "options");
  p.seed = file.natural("/", "seed");
  p.utc_time = file.text("/", "utc_time");
  p.host = file.text("/", "host");
  return p;
}

void write_knots(Writer& file, const std::string& group, const Knots& knots) {
  const auto n = static_cast<hsize_t>(knots.size());
  // Columns of a 4 x N matrix lie in memory as the rows of N x 4; complex numbers as pairs.
  file.array(group + "/knots", {n, 4}, knots.points.data());
  file.array(group + "/weights", {n, 2}, reinterpret_cast<const double*>(knots.weights.data()));
}

Knots read_knots(const Reader& file, const std::string& group) {
  const Shape shape = file.shape(group + "/knots");
  const hsize_t n = shape.empty() ? 0 : shape[0];
  const std::vector<double> points = file.reals(group + "/knots", {n, 4});
  const std::vector<double> weights = file.reals(group + "/weights", {n, 2});
  Knots knots;
  knots.points.resize(4, static_cast<Eigen::Index>(n));
  knots.weights.resize(static_cast<Eigen::Index>(n));
  std::copy(points.begin(), points.end(), knots.points.data());
  std::copy(weights.begin(), weights.end(), reinterpret_cast<double*>(knots.weights.data()));
  return knots;
}

void write_figures(Writer& file, const std::string& group, const std::vector<Figure>& figures) {
  file.group(group);
  for (const Figure& figure : figures) file.attribute(group, figure.name, figure.value);
}

std::vector<Figure> read_figures(const Reader& file, const std::string& group) {
  std::vector<Figure> figures;
  for (const std::string& name : file.attributes(group))
    figures.push_back({name, file.real(group, name)});
  return figures;
}

void check_names(const std::vector<std::string>& names, const std::string& where) {
  const auto refuse = [&](const std::string& name, const char* why) {
    std::string message = where;
    message.append(": the name \"").append(name).append("\" ").append(why);
    throw InputError(message);
  };
  std::vector<std::string> sorted = names;
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    const std::string& name = sorted[i];
    if (name.empty() || name == "." || name.find('/') != std::string::npos ||
        name.find('\0') != std::string::npos)
      refuse(name, "cannot be stored: expected one that is not empty, not \".\" and without \"/\"");
    if (i > 0 && name == sorted[i - 1]) refuse(name, "appears twice");
  }
}

}  // namespace mortise::hdf5
