// SPDX-License-Identifier: GPL-3.0-or-later
// The double skin of a solid on a grid.
#include "mortise/assembly/part_field.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <string>
#include <vector>

#include "mortise/core/errors.hpp"
#include "mortise/parts/distance_grid.hpp"
#include "mortise/parts/skeletal_density.hpp"

namespace mortise {

double default_thickness(const Solid& solid) { return 0.15 * solid.bounds().sizes().maxCoeff(); }

BodyDensity double_skin_field(const Solid& solid, const PartFieldOptions& options) {
  if (options.grid < 8)
    throw InputError("double_skin_field: grid must be >= 8, got " + std::to_string(options.grid));
  if (!(options.penalty > 0.0))
    throw InputError("double_skin_field: penalty must be > 0, got " +
                     std::to_string(options.penalty));
  if (!(options.thickness >= 0.0) || !std::isfinite(options.thickness))
    throw InputError("double_skin_field: thickness must be >= 0, got " +
                     std::to_string(options.thickness));
  const Eigen::AlignedBox3d box = solid.bounds();
  const double thickness = options.thickness > 0.0 ? options.thickness : default_thickness(solid);
  const GridNodes nodes = grid_around(box, options.grid, thickness);
  const double step = nodes.spacing;
  const DistanceGrid distance =
      distance_grid(solid, nodes, {.band = thickness + step, .threads = options.threads});
  std::vector<std::complex<float>> values(distance.values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double d = static_cast<double>(distance.values[i]);
    const double core = std::clamp(-d / step, 0.0, 1.0);
    const double skin = d > 0.0 && d < thickness
                            ? 0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * d / thickness)
                            : 0.0;
    values[i] = {0.0F, static_cast<float>(skin - options.penalty * core)};
  }
  return density_of_samples(values, {nodes.size[0], nodes.size[1], nodes.size[2]}, nodes.origin,
                            step);
}

BodyDensity skeletal_field(const MeshSolid& solid, const SkeletalFieldOptions& options) {
  if (options.grid < 8)
    throw InputError("skeletal_field: grid must be >= 8, got " + std::to_string(options.grid));
  if (!(options.penalty > 0.0))
    throw InputError("skeletal_field: penalty must be > 0, got " + std::to_string(options.penalty));
  if (!(options.margin >= 0.0) || !std::isfinite(options.margin))
    throw InputError("skeletal_field: margin must be >= 0, got " + std::to_string(options.margin));
  const double margin = options.margin > 0.0 ? options.margin : default_thickness(solid);
  const GridNodes nodes = grid_around(solid.bounds(), options.grid, margin);
  const DistanceGrid distance = distance_grid(solid, nodes, {.threads = options.threads});
  SkeletalDensity density = skeletal_density(
      solid, distance,
      {.thickness = options.sigma, .penalty = options.penalty, .threads = options.threads});
  for (std::size_t i = 0; i < density.values.size(); ++i) {
    const double d = static_cast<double>(distance.values[i]) / margin;
    if (d > 0.5)
      density.values[i] *= static_cast<float>(
          d < 1.0 ? 0.5 + 0.5 * std::cos(2.0 * std::numbers::pi * (d - 0.5)) : 0.0);
  }
  return density_of_samples(density.values, {nodes.size[0], nodes.size[1], nodes.size[2]},
                            nodes.origin, nodes.spacing);
}

}  // namespace mortise
