// SPDX-License-Identifier: GPL-3.0-or-later
// Presets of mating and its options as JSON.
#include <nlohmann/json.hpp>

#include "mortise/core/errors.hpp"
#include "mortise/runs/mate.hpp"

namespace mortise {

MateOptions mate_preset(const std::string& name) {
  MateOptions options;
  if (name == "default") return options;
  if (name == "fast") {
    options.rotations = 60;
    return options;
  }
  if (name == "thorough") {
    options.rotations = 3600;
    options.polished = 200;
    return options;
  }
  throw InputError("preset '" + name + "' is not one of fast, default, thorough");
}

std::string to_json(const MateOptions& o) {
  const auto vector = [](const Eigen::Vector3d& v) {
    return nlohmann::ordered_json{v[0], v[1], v[2]};
  };
  nlohmann::ordered_json json = {
      {"rotations", o.rotations},
      {"aligned", o.aligned},
      {"turns", o.turns},
      {"axis", nullptr},
      {"spacing", o.spacing},
      {"most_cells", o.most_cells},
      {"per_rotation", o.per_rotation},
      {"separation", o.separation},
      {"skin", o.skin},
      {"penalty", o.penalty},
      {"feature", o.feature},
      {"skeletal", o.skeletal},
      {"detail", o.detail},
      {"tolerance", o.tolerance},
      {"flat", o.flat},
      {"overlap", o.overlap},
      {"samples", o.samples},
      {"polished", o.polished},
      {"poses", o.poses},
      {"cluster_radius", o.cluster_radius},
  };
  if (o.axis) json["axis"] = {{"fixed", vector(o.axis->fixed)}, {"moving", vector(o.axis->moving)}};
  return json.dump();
}

}  // namespace mortise
