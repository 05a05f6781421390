// SPDX-License-Identifier: GPL-3.0-or-later
// Early misses: partial sums with a bound on the rest; derivation in docs/math.md.
#include <algorithm>
#include <cmath>
#include <mutex>
#include <numeric>
#include <vector>

#include "collision/gap_state.hpp"
#include "mortise/core/errors.hpp"
#include "mortise/kernels/ball.hpp"

namespace mortise {

double ball_energy(const BodyDensity& density) {
  // In the order of their first coordinate, so that each ball looks at few others.
  std::vector<Eigen::Index> order(static_cast<std::size_t>(density.size()));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  std::sort(order.begin(), order.end(), [&](Eigen::Index i, Eigen::Index j) {
    return density.points(0, i) < density.points(0, j);
  });
  const double largest = density.radii.maxCoeff();
  double sum = 0.0;
  for (std::size_t a = 0; a < order.size(); ++a) {
    const Eigen::Index i = order[a];
    const double weight = density.weights[i].real(), radius = density.radii[i];
    sum += weight * weight * ball_overlap_volume(radius, radius, 0.0);
    for (std::size_t b = a + 1; b < order.size(); ++b) {
      const Eigen::Index j = order[b];
      if (density.points(0, j) - density.points(0, i) >= radius + largest) break;
      const double d = (density.points.col(i) - density.points.col(j)).norm();
      if (d < radius + density.radii[j])
        sum += 2.0 * weight * density.weights[j].real() *
               ball_overlap_volume(radius, density.radii[j], d);
    }
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
}

double GapFunction::State::moving_energy() const {
  if (coefficients.cols() != 1 || moving.radii.size() == 0 || !std::isinf(moving.kernel.alpha()))
    throw InputError("GapFunction::reject: only for real densities of balls");
  std::call_once(energy_known, [&] { known_energy = box * box * box * ball_energy(moving); });
  return known_energy;
}

GapFunction::Rejection GapFunction::reject(const RigidMotion& pose, double threshold) const {
  check_motion(pose, "GapFunction::reject");
  const State& s = *state_;
  const double moving_energy = s.moving_energy();
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
    const double left = std::sqrt(std::max(0.0, moving_energy - sure * sure));
    const double bound = value + s.head[b + 1] * error + s.tail[b + 1] * left;
    const bool last = b + 1 == blocks;
    if (bound < threshold || last)
      return {bound < threshold, std::min(modes(), static_cast<int>(summed) - 1), bound};
  }
  return {};
}

}  // namespace mortise
