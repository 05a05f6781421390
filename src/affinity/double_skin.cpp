// SPDX-License-Identifier: GPL-3.0-or-later
// Double-skin affinity of balls.
#include "mortise/affinity/double_skin.hpp"

#include <cmath>
#include <complex>
#include <string>

#include "mortise/core/errors.hpp"
#include "mortise/kernels/ball.hpp"

namespace mortise {

RadialTransform double_skin_transform(const DoubleSkinOptions& options) {
  if (!(options.offset > 0.0) || !std::isfinite(options.offset))
    throw InputError("double skin: offset must be > 0 and finite, got " +
                     std::to_string(options.offset));
  if (!(options.penalty >= 0.0) || !std::isfinite(options.penalty))
    throw InputError("double skin: penalty must be >= 0 and finite, got " +
                     std::to_string(options.penalty));
  if (!(options.penalty_radius >= 0.0) || !std::isfinite(options.penalty_radius))
    throw InputError("double skin: penalty radius must be >= 0 and finite, got " +
                     std::to_string(options.penalty_radius));
  // Core over skin by volume, at the radius for which the penalty is given.
  const double share =
      options.penalty_radius > 0.0
          ? options.penalty *
                std::pow(options.penalty_radius / (options.penalty_radius + options.offset), 3)
          : 0.0;
  return [options, share](double k, double r) {
    const double penalty = options.penalty_radius > 0.0
                               ? share * std::pow((r + options.offset) / r, 3)
                               : options.penalty;
    return ball_transform(k, r + options.offset) - penalty * ball_transform(k, r);
  };
}

Channel double_skin_channel(const Knots& fixed, const Knots& moving,
                            const DoubleSkinOptions& options) {
  const RadialTransform transform = double_skin_transform(options);
  Channel channel{"shape", 1.0, fixed, moving, transform, transform, 0.0};
  channel.pair = [options](double d, double a, double b) {
    const double r0 = options.offset, penalty = options.penalty;
    return penalty * penalty * ball_overlap_volume(a, b, d) -
           penalty * (ball_overlap_volume(a + r0, b, d) + ball_overlap_volume(a, b + r0, d)) +
           ball_overlap_volume(a + r0, b + r0, d);
  };
  for (Knots* knots : {&channel.fixed, &channel.moving}) {
    if (!(knots->weights.imag().array() == 0.0).all())  // NaN fails too
      throw InputError("double skin: knot weights must be real; they become the affinity's i w");
    knots->weights *= std::complex<double>(0.0, 1.0);
  }
  check_channel(channel, "double skin");
  channel.range =
      fixed.points.row(3).maxCoeff() + moving.points.row(3).maxCoeff() + 2.0 * options.offset;
  return channel;
}

}  // namespace mortise
