// SPDX-License-Identifier: GPL-3.0-or-later
// Fields on grids as knots with Gaussian kernels.
#include "mortise/affinity/sampled_field.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mortise/core/errors.hpp"

namespace mortise {

Channel sampled_channel(const std::string& name, double weight, const Knots& fixed,
                        const Knots& moving, double spacing) {
  if (!(spacing > 0.0) || !std::isfinite(spacing))
    throw InputError("sampled channel: spacing must be > 0 and finite, got " +
                     std::to_string(spacing));
  const double volume = spacing * spacing * spacing;
  const double width = kNodeWidth * spacing;
  const RadialTransform transform = [volume, width](double k, double) {
    const double u = std::numbers::pi * k * width;
    return volume * std::exp(-2.0 * u * u);
  };
  Channel channel{name, weight, fixed, moving, transform, transform, 6.0 * width};
  channel.fixed.points.row(3).setConstant(0.5 * spacing);
  channel.moving.points.row(3).setConstant(0.5 * spacing);
  check_channel(channel, "sampled channel");
  return channel;
}

Knots sample_double_skin(const Eigen::Matrix3Xd& nodes, const Eigen::VectorXd& distance,
                         const SampledSkinOptions& options) {
  if (!(options.spacing > 0.0) || !(options.offset > 0.0) || !(options.penalty > 1.0) ||
      !std::isfinite(options.spacing + options.offset + options.penalty))
    throw InputError("sampled skin: spacing and offset must be > 0 and the penalty > 1, got " +
                     std::to_string(options.spacing) + ", " + std::to_string(options.offset) +
                     " and " + std::to_string(options.penalty));
  if (nodes.cols() != distance.size())
    throw InputError("sampled skin: expected one distance per node");
  const auto share = [&](double d) { return std::clamp(0.5 - d / options.spacing, 0.0, 1.0); };
  std::vector<Eigen::Index> kept;
  bool inside = false;
  for (Eigen::Index i = 0; i < distance.size(); ++i) {
    if (share(distance[i] - options.offset) > 0.0) kept.push_back(i);
    inside = inside || distance[i] < 0.0;
  }
  if (!inside) throw InputError("sampled skin: expected a node inside the solid, found none");
  Knots knots;
  knots.points.resize(4, static_cast<Eigen::Index>(kept.size()));
  knots.weights.resize(static_cast<Eigen::Index>(kept.size()));
  for (std::size_t k = 0; k < kept.size(); ++k) {
    const auto at = static_cast<Eigen::Index>(k);
    const double d = distance[kept[k]];
    knots.points.col(at) << nodes.col(kept[k]), 0.5 * options.spacing;
    knots.weights[at] = {0.0, share(d - options.offset) - options.penalty * share(d)};
  }
  return knots;
}

}  // namespace mortise
