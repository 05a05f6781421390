// SPDX-License-Identifier: GPL-3.0-or-later
// Early misses: partial sums with a bound on the rest; derivation in docs/math.md.
#include <algorithm>
#include <cmath>

#include "collision/gap_state.hpp"
#include "mortise/core/errors.hpp"
#include "mortise/kernels/ball.hpp"

namespace mortise {

double ball_energy(const BodyDensity& density) {
  double sum = 0.0;
  for (Eigen::Index i = 0; i < density.size(); ++i)
    for (Eigen::Index j = 0; j < density.size(); ++j) {
      const double d = (density.points.col(i) - density.points.col(j)).norm();
      if (d < density.radii[i] + density.radii[j])
        sum += density.weights[i].real() * density.weights[j].real() *
               ball_overlap_volume(density.radii[i], density.radii[j], d);
    }
  return sum;
}

void GapFunction::State::measure_tails() {
  const std::size_t blocks = (modes.size() + kModeBlock - 1) / kModeBlock;
  tail.assign(blocks + 1, 0.0);
  head.assign(blocks + 1, 0.0);
  for (std::size_t i = modes.size(); i-- > 0;) {
    // A pair's coefficient holds 2 K F / L^3.
    const double pair = std::norm(coefficients(static_cast<Eigen::Index>(i), 0));
    tail[i / kModeBlock] += modes[i].isZero() ? pair : 0.5 * pair;
  }
  for (std::size_t b = blocks; b-- > 0;) tail[b] += tail[b + 1];
  for (double& t : tail) t = std::sqrt(t);
  for (std::size_t i = 0; i < modes.size(); ++i)
    head[i / kModeBlock + 1] += std::abs(coefficients(static_cast<Eigen::Index>(i), 0));
  for (std::size_t b = 0; b < blocks; ++b) head[b + 1] += head[b];
  for (Eigen::Index i = 0; i < moving.size(); ++i)
    moving_mass += std::abs(moving.weights[i]) *
                   (moving.radii.size() > 0 ? moving.kernel.volume(moving.radii[i]) : 1.0);
  if (coefficients.cols() == 1 && moving.radii.size() > 0 && std::isinf(moving.kernel.alpha()))
    moving_energy = box * box * box * ball_energy(moving);
}

GapFunction::Rejection GapFunction::reject(const RigidMotion& pose, double threshold) const {
  const State& s = *state_;
  if (s.moving_energy < 0.0)
    throw InputError("GapFunction::reject: only for real densities of balls");
  const Eigen::Vector3d t = s.shift(pose);
  if (!(t.norm() < s.fixed_ball.radius + s.moving_ball.radius)) return {threshold > 0.0, 0, 0.0};
  GapJob job = s.job(pose.rotation.toRotationMatrix(), t, 0);
  job.count = kModeBlock;
  const double error = s.kernel.error_bound * s.moving_mass;  // of one interpolated G
  double value = 0.0;
  // Mode 0 has no opposite but is doubled below.
  double energy = -std::pow(s.moving_mass + error, 2);
  const std::size_t blocks = s.tail.size() - 1;
  for (std::size_t b = 0; b < blocks; ++b) {
    double block_value = 0.0, block_energy = 0.0;
    s.table->probe(job, &block_value, &block_energy);
    job.kx += kModeBlock, job.ky += kModeBlock, job.kz += kModeBlock;
    job.real += kModeBlock, job.imag += kModeBlock;
    value += block_value;
    energy +=
        b + 1 < blocks ? 2.0 * block_energy : 0.0;  // the last block is padded; nothing is left
    const double summed = static_cast<double>(2 * kModeBlock) * static_cast<double>(b + 1);
    // |G| of each mode is below its interpolant by at most `error`.
    const double sure = std::max(0.0, std::sqrt(std::max(0.0, energy)) - std::sqrt(summed) * error);
    const double left = std::sqrt(std::max(0.0, s.moving_energy - sure * sure));
    const double bound = value + s.head[b + 1] * error + s.tail[b + 1] * left;
    const bool last = b + 1 == blocks;
    if (bound < threshold || last)
      return {bound < threshold, std::min(modes(), static_cast<int>(summed) - 1), bound};
  }
  return {};
}

}  // namespace mortise
