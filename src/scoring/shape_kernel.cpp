// SPDX-License-Identifier: GPL-3.0-or-later
// Pair score of knots by distance, from the channel's transforms.
#include "mortise/scoring/shape_kernel.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "mortise/core/errors.hpp"

namespace mortise {

double TabulatedKernel::operator()(double d_sq) const {
  const double at = d_sq / (range * range) * static_cast<double>(values.size() - 1);
  if (!(at < static_cast<double>(values.size() - 1))) return 0.0;
  const auto i = static_cast<std::size_t>(at);
  return values[i] + (at - static_cast<double>(i)) * (values[i + 1] - values[i]);
}

TabulatedKernel shape_kernel(const Channel& channel, double fixed_radius, double moving_radius,
                             const LowPass& low_pass) {
  if (!(low_pass.cutoff > 0.0) || !std::isfinite(low_pass.cutoff))
    throw InputError("shape kernel: the low-pass' cutoff must be > 0 and finite, got " +
                     std::to_string(low_pass.cutoff));
  if (!(fixed_radius > 0.0) || !(moving_radius > 0.0))
    throw InputError("shape kernel: radii must be > 0, got " + std::to_string(fixed_radius) +
                     " and " + std::to_string(moving_radius));
  // Window and k^2 vanish at the ends of the interval, so that the midpoint rule converges fast: at
  // the default cutoff the fastest oscillation, at the range, has 2.75 periods.
  constexpr int kNodes = 256;
  constexpr int kEntries = 2048;
  const double step = low_pass.cutoff / kNodes;
  std::vector<double> frequency(kNodes), weight(kNodes);
  for (int n = 0; n < kNodes; ++n) {
    const double k = (n + 0.5) * step;
    frequency[n] = k;
    weight[n] = channel.weight * channel.fixed_transform(k, fixed_radius) *
                channel.moving_transform(k, moving_radius) * low_pass(k) * 4.0 * std::numbers::pi *
                k * k * step;
  }
  TabulatedKernel kernel{channel.range + 1.15 / low_pass.cutoff, std::vector<double>(kEntries)};
  const double taper = kernel.range - 0.5 / low_pass.cutoff;
  for (int i = 0; i < kEntries; ++i) {
    const double d = kernel.range * std::sqrt(i / (kEntries - 1.0));
    double sum = 0.0;
    for (int n = 0; n < kNodes; ++n) {
      const double u = 2.0 * std::numbers::pi * frequency[n] * d;
      sum += weight[n] * (u > 1e-6 ? std::sin(u) / u : 1.0);
    }
    const double past = std::clamp((d - taper) / (kernel.range - taper), 0.0, 1.0);
    kernel.values[i] = sum * 0.5 * (1.0 + std::cos(std::numbers::pi * past));
  }
  return kernel;
}

}  // namespace mortise
