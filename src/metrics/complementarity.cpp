// SPDX-License-Identifier: GPL-3.0-or-later
// Lawrence and Colman's statistic on surface dots.
#include "metrics/complementarity.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/nearest_point.hpp"
#include "core/point_grid.hpp"
#include "mortise/core/errors.hpp"

namespace mortise::detail {
namespace {

// Dots of one trimmed interface in the fixed body's frame.
struct Side {
  Eigen::Matrix3Xd positions, normals;
  Eigen::VectorXd areas;
};

Side side(const SurfaceDots& dots, const std::vector<std::int32_t>& chosen,
          const RigidMotion& motion) {
  const auto count = static_cast<Eigen::Index>(chosen.size());
  Side out{Eigen::Matrix3Xd(3, count), Eigen::Matrix3Xd(3, count), Eigen::VectorXd(count)};
  const Eigen::Matrix3d R = motion.rotation.toRotationMatrix();
  for (Eigen::Index k = 0; k < count; ++k) {
    const std::int32_t dot = chosen[k];
    out.positions.col(k) = R * dots.positions.col(dot) + motion.translation;
    out.normals.col(k) = R * dots.normals.col(dot);
    out.areas[k] = dots.areas[dot];
  }
  return out;
}

// The value below which half of the weight lies.
double weighted_median(std::vector<std::pair<double, double>>& value_and_weight) {
  std::sort(value_and_weight.begin(), value_and_weight.end());
  double total = 0.0;
  for (const auto& [value, weight] : value_and_weight) total += weight;
  double sum = 0.0;
  for (const auto& [value, weight] : value_and_weight)
    if ((sum += weight) >= 0.5 * total) return value;
  return value_and_weight.back().first;
}

struct OneWay {
  double s, gap;
};

OneWay one_way(const Side& from, const Side& to, double weight) {
  // Farther off S is below 3e-9: zero.
  const double limit = std::sqrt(20.0 / weight);
  const NearestPoint nearest(to.positions, 1.0);
  std::vector<std::pair<double, double>> s, gap;
  s.reserve(static_cast<std::size_t>(from.areas.size()));
  gap.reserve(s.capacity());
  for (Eigen::Index k = 0; k < from.areas.size(); ++k) {
    const NearestPoint::Found found = nearest(from.positions.col(k), limit);
    const double value = found.index < 0 ? 0.0
                                         : -from.normals.col(k).dot(to.normals.col(found.index)) *
                                               std::exp(-weight * found.distance_sq);
    s.emplace_back(value, from.areas[k]);
    gap.emplace_back(std::sqrt(found.distance_sq), from.areas[k]);
  }
  return {weighted_median(s), weighted_median(gap)};
}

}  // namespace

void check_complementarity_options(const ComplementarityOptions& options) {
  for (const auto& [name, value] :
       {std::pair("probe_radius", options.probe_radius), std::pair("density", options.density),
        std::pair("trim", options.trim), std::pair("weight", options.weight)})
    if (!(value > 0.0 && std::isfinite(value)))
      throw InputError(std::string("shape_complementarity: ") + name +
                       " must be > 0 and finite, got " + std::to_string(value));
}

DottedBody::DottedBody(const Eigen::Matrix3Xd& centres, const Eigen::VectorXd& radii,
                       const ComplementarityOptions& options)
    : centres_(centres),
      dots_(molecular_surface(centres, radii,
                              {.probe_radius = options.probe_radius,
                               .density = options.density,
                               .threads = options.threads})),
      places_{dots_.positions + options.probe_radius * dots_.normals,
              std::vector<Eigen::Index>(static_cast<std::size_t>(radii.size()) + 1, 0),
              (radii.array() + options.probe_radius).matrix()},
      cells_(dots_.positions, options.trim) {
  for (const std::int32_t atom : dots_.atoms) ++places_.first[atom + 1];
  for (std::size_t i = 1; i < places_.first.size(); ++i) places_.first[i] += places_.first[i - 1];
}

std::vector<std::int32_t> DottedBody::interface(const Neighbours& neighbours,
                                                const Eigen::Matrix3Xd& partners,
                                                const Eigen::VectorXd& partner_grown) const {
  std::vector<std::int32_t> buried;
  for_each_covered(places_, centres_, neighbours, partners, partner_grown,
                   [&](Eigen::Index dot) { buried.push_back(static_cast<std::int32_t>(dot)); });
  return cells_.far_from_others(buried, dots_.positions);
}

Complementarity complementarity(const DottedBody& fixed, const DottedBody& moving,
                                const RigidMotion& motion, const NearPairs& pairs,
                                const Eigen::Matrix3Xd& fixed_in_moving,
                                const Eigen::Matrix3Xd& moving_in_fixed, double weight) {
  const Side a =
      side(fixed.dots(), fixed.interface(pairs.fixed, moving_in_fixed, moving.grown()), {});
  const Side b =
      side(moving.dots(), moving.interface(pairs.moving, fixed_in_moving, fixed.grown()), motion);
  Complementarity out;
  if (a.areas.size() == 0 || b.areas.size() == 0) return out;
  const OneWay ab = one_way(a, b, weight), ba = one_way(b, a, weight);
  out.fixed_to_moving = ab.s;
  out.moving_to_fixed = ba.s;
  out.sc = 0.5 * (ab.s + ba.s);
  out.gap = 0.5 * (ab.gap + ba.gap);
  out.area = 0.5 * (a.areas.sum() + b.areas.sum());
  return out;
}

}  // namespace mortise::detail

namespace mortise {

Complementarity shape_complementarity(const Eigen::Matrix3Xd& fixed,
                                      const Eigen::VectorXd& fixed_radii,
                                      const Eigen::Matrix3Xd& moving,
                                      const Eigen::VectorXd& moving_radii,
                                      const ComplementarityOptions& options) {
  detail::check_complementarity_options(options);
  const detail::DottedBody a(fixed, fixed_radii, options), b(moving, moving_radii, options);
  if (fixed.cols() == 0 || moving.cols() == 0) return {};
  const double reach = a.grown().maxCoeff() + b.grown().maxCoeff();
  const detail::NearPairs pairs =
      detail::near_pairs(detail::PointGrid(fixed, reach, reach), fixed.cols(), moving);
  return detail::complementarity(a, b, {}, pairs, fixed, moving, options.weight);
}

}  // namespace mortise
