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

namespace {

// Window and k^2 vanish at the ends of the interval, so that the midpoint rule converges fast.
// Enough nodes that the fastest oscillation, at the range, has 40 a period; at the default cutoff
// 256 have 90.
int node_count(double range, double cutoff) {
  return std::max(256, static_cast<int>(std::ceil(40.0 * range * cutoff)));
}

constexpr int kEntries = 2048;

double kernel_range(double channel_range, double cutoff) { return channel_range + 1.15 / cutoff; }

void check_low_pass(const LowPass& low_pass) {
  if (!(low_pass.cutoff > 0.0) || !std::isfinite(low_pass.cutoff))
    throw InputError("shape kernel: the low-pass' cutoff must be > 0 and finite, got " +
                     std::to_string(low_pass.cutoff));
}

// Radial functions of distance from values of their transforms: transforms(k) gives `count` of
// them.
template <class Transforms>
std::vector<TabulatedKernel> tabulate(const Transforms& transforms, Eigen::Index count,
                                      double range, const LowPass& low_pass) {
  const int nodes = node_count(range, low_pass.cutoff);
  const double step = low_pass.cutoff / nodes;
  std::vector<double> frequency(nodes);
  Eigen::MatrixXd weights(count, nodes);
  for (int n = 0; n < nodes; ++n) {
    const double k = (n + 0.5) * step;
    frequency[n] = k;
    weights.col(n) = transforms(k) * low_pass(k) * 4.0 * std::numbers::pi * k * k * step;
  }
  std::vector<TabulatedKernel> kernels(count, {range, std::vector<double>(kEntries)});
  const double taper = range - 0.5 / low_pass.cutoff;
  for (int i = 0; i < kEntries; ++i) {
    const double d = range * std::sqrt(i / (kEntries - 1.0));
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(count);
    for (int n = 0; n < nodes; ++n) {
      const double u = 2.0 * std::numbers::pi * frequency[n] * d;
      sum += (u > 1e-6 ? std::sin(u) / u : 1.0) * weights.col(n);
    }
    const double past = std::clamp((d - taper) / (range - taper), 0.0, 1.0);
    sum *= 0.5 * (1.0 + std::cos(std::numbers::pi * past));
    for (Eigen::Index c = 0; c < count; ++c) kernels[c].values[i] = sum[c];
  }
  return kernels;
}

CompressedRadius compress(const Knots& knots, const RadialTransform& transform,
                          const std::vector<double>& offsets, const ShapeKernelsOptions& options) {
  check_low_pass(options.low_pass);
  check_knots(knots, "shape kernel");
  return compress_radius(
      transform, options.low_pass.cutoff,
      std::vector<double>(knots.points.row(3).begin(), knots.points.row(3).end()),
      {.tolerance = options.radius_tolerance, .offsets = offsets, .low_pass = options.low_pass});
}

}  // namespace

TabulatedKernel shape_kernel(const Channel& channel, double fixed_radius, double moving_radius,
                             const LowPass& low_pass) {
  check_low_pass(low_pass);
  if (!(fixed_radius > 0.0) || !(moving_radius > 0.0))
    throw InputError("shape kernel: radii must be > 0, got " + std::to_string(fixed_radius) +
                     " and " + std::to_string(moving_radius));
  const auto transform = [&](double k) {
    return Eigen::VectorXd(
        Eigen::VectorXd::Constant(1, channel.weight * channel.fixed_transform(k, fixed_radius) *
                                         channel.moving_transform(k, moving_radius)));
  };
  return tabulate(transform, 1, kernel_range(channel.range, low_pass.cutoff), low_pass)[0];
}

ShapeKernels::ShapeKernels(const Channel& channel, const ShapeKernelsOptions& options)
    : fixed_(compress(channel.fixed, channel.fixed_transform, {0.0}, options)),
      moving_(compress(channel.moving, channel.moving_transform, options.offsets, options)),
      range_(kernel_range(channel.range + std::max(0.0, *std::max_element(options.offsets.begin(),
                                                                          options.offsets.end())),
                          options.low_pass.cutoff)) {
  const Eigen::Index fixed_terms = fixed_.terms(), pairs = fixed_terms * moving_.terms();
  const auto transforms = [&](double k) {
    Eigen::VectorXd products(pairs * static_cast<Eigen::Index>(options.offsets.size()));
    const Eigen::VectorXd f = channel.weight * fixed_.frequency_factors(k);
    for (std::size_t o = 0; o < options.offsets.size(); ++o) {
      const Eigen::VectorXd m = moving_.frequency_factors(k, o);
      for (Eigen::Index q = 0; q < m.size(); ++q)
        products.segment(static_cast<Eigen::Index>(o) * pairs + q * fixed_terms, fixed_terms) =
            f * m[q];
    }
    return products;
  };
  tables_ = tabulate(transforms, pairs * static_cast<Eigen::Index>(options.offsets.size()), range_,
                     options.low_pass);
}

TabulatedKernel ShapeKernels::kernel(double fixed_radius, int term, std::size_t offset) const {
  if (term < 0 || term >= terms() || offset >= moving_.offsets().size())
    throw InputError("shape kernels: no term " + std::to_string(term) + " or offset " +
                     std::to_string(offset));
  const Eigen::VectorXd b = fixed_.radius_factors(fixed_radius);
  TabulatedKernel kernel{range_, std::vector<double>(kEntries, 0.0)};
  for (Eigen::Index p = 0; p < b.size(); ++p) {
    const TabulatedKernel& table =
        tables_[(offset * terms() + static_cast<std::size_t>(term)) * b.size() + p];
    for (int i = 0; i < kEntries; ++i) kernel.values[i] += b[p] * table.values[i];
  }
  return kernel;
}

double ShapeKernels::pair(double fixed_radius, double moving_radius, double d_sq,
                          std::size_t offset) const {
  const Eigen::VectorXd f = fixed_.radius_factors(fixed_radius),
                        m = moving_.radius_factors(moving_radius);
  double sum = 0.0;
  for (Eigen::Index q = 0; q < m.size(); ++q)
    for (Eigen::Index p = 0; p < f.size(); ++p)
      sum += f[p] * m[q] * tables_.at((offset * terms() + q) * f.size() + p)(d_sq);
  return sum;
}

}  // namespace mortise
