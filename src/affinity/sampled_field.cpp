// SPDX-License-Identifier: GPL-3.0-or-later
// Fields on grids as knots with Gaussian kernels.
#include "mortise/affinity/sampled_field.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

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
  // Two Gaussians of that width make one of twice the variance.
  channel.pair = [volume, width](double d, double, double) {
    return volume * volume * std::exp(-d * d / (4.0 * width * width)) /
           std::pow(4.0 * std::numbers::pi * width * width, 1.5);
  };
  channel.fixed.points.row(3).setConstant(0.5 * spacing);
  channel.moving.points.row(3).setConstant(0.5 * spacing);
  check_channel(channel, "sampled channel");
  return channel;
}

namespace {

// Share of a ball of radius 1 beyond a plane at distance t of its centre.
double cap(double t) {
  const double c = std::clamp(t, -1.0, 1.0);
  return (1.0 - c) * (1.0 - c) * (2.0 + c) / 4.0;
}

// For each node kept: (v / v0)^p outside, ((1 - v) / v0)^p inside.
Eigen::VectorXd feature_weights(const Eigen::Matrix3Xd& nodes, const Eigen::VectorXd& distance,
                                const std::vector<Eigen::Index>& kept,
                                const SampledSkinOptions& options) {
  const double h = options.spacing;
  const Eigen::Vector3d low = nodes.rowwise().minCoeff();
  const Eigen::Vector3i size =
      ((nodes.rowwise().maxCoeff() - low) / h).array().round().matrix().cast<int>() +
      Eigen::Vector3i::Ones();
  const auto place = [&](const Eigen::Vector3i& c) {
    return (static_cast<std::size_t>(c[0]) * size[1] + c[1]) * size[2] + c[2];
  };
  const auto cell_of = [&](Eigen::Index i) -> Eigen::Vector3i {
    return ((nodes.col(i) - low) / h).array().round().matrix().cast<int>();
  };
  std::vector<float> filled(static_cast<std::size_t>(size[0]) * size[1] * size[2], 0.0F);
  for (Eigen::Index i = 0; i < nodes.cols(); ++i)
    filled[place(cell_of(i))] = static_cast<float>(std::clamp(0.5 - distance[i] / h, 0.0, 1.0));
  std::vector<Eigen::Vector3i> ball;
  const int reach = static_cast<int>(options.feature_radius / h);
  for (int i = -reach; i <= reach; ++i)
    for (int j = -reach; j <= reach; ++j)
      for (int k = -reach; k <= reach; ++k)
        if (h * h * (i * i + j * j + k * k) <= options.feature_radius * options.feature_radius)
          ball.emplace_back(i, j, k);
  constexpr double kMost = 8.0;  // an emphasis beyond this is a single node's accident
  Eigen::VectorXd result(static_cast<Eigen::Index>(kept.size()));
  for (std::size_t n = 0; n < kept.size(); ++n) {
    const Eigen::Vector3i centre = cell_of(kept[n]);
    double sum = 0.0;
    for (const Eigen::Vector3i& step : ball) {
      const Eigen::Vector3i c = centre + step;
      if ((c.array() >= 0).all() && (c.array() < size.array()).all()) sum += filled[place(c)];
    }
    const double v = sum / static_cast<double>(ball.size());
    const double d = distance[kept[n]];
    // Deep inside, beyond the ball's reach, everything is flat.
    const double flat = std::max(cap(std::abs(d) / options.feature_radius), 0.02);
    const double ratio = std::max((d >= 0.0 ? v : 1.0 - v) / flat, 0.1);
    const bool deep = d <= -options.feature_radius;
    result[static_cast<Eigen::Index>(n)] =
        deep ? 1.0 : std::min(kMost, std::pow(ratio, options.feature));
  }
  return result;
}

}  // namespace

Knots sample_double_skin(const Eigen::Matrix3Xd& nodes, const Eigen::VectorXd& distance,
                         const SampledSkinOptions& options) {
  if (!(options.spacing > 0.0) || !(options.offset > 0.0) || !(options.penalty > 1.0) ||
      !std::isfinite(options.spacing + options.offset + options.penalty))
    throw InputError("sampled skin: spacing and offset must be > 0 and the penalty > 1, got " +
                     std::to_string(options.spacing) + ", " + std::to_string(options.offset) +
                     " and " + std::to_string(options.penalty));
  if (!(options.feature >= 0.0) || !(options.feature_radius > 0.0) ||
      !std::isfinite(options.feature + options.feature_radius))
    throw InputError("sampled skin: feature must be >= 0 and its radius > 0");
  if (nodes.cols() != distance.size())
    throw InputError("sampled skin: expected one distance per node");
  const auto share = [&](double d) { return std::clamp(0.5 - d / options.spacing, 0.0, 1.0); };
  std::vector<Eigen::Index> kept;
  bool inside = false;
  for (Eigen::Index i = 0; i < distance.size(); ++i) {
    if (share(distance[i] - options.offset) > 0.0) kept.push_back(i);
    inside = inside || distance[i] < 0.0;
  }
  const Eigen::VectorXd emphasis =
      options.feature > 0.0 ? feature_weights(nodes, distance, kept, options)
                            : Eigen::VectorXd::Ones(static_cast<Eigen::Index>(kept.size()));
  if (!inside) throw InputError("sampled skin: expected a node inside the solid, found none");
  Knots knots;
  knots.points.resize(4, static_cast<Eigen::Index>(kept.size()));
  knots.weights.resize(static_cast<Eigen::Index>(kept.size()));
  for (std::size_t k = 0; k < kept.size(); ++k) {
    const auto at = static_cast<Eigen::Index>(k);
    const double d = distance[kept[k]];
    knots.points.col(at) << nodes.col(kept[k]), 0.5 * options.spacing;
    knots.weights[at] = {0.0,
                         emphasis[at] * (share(d - options.offset) - options.penalty * share(d))};
  }
  return knots;
}

}  // namespace mortise
