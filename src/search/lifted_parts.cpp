// SPDX-License-Identifier: GPL-3.0-or-later
// Channels as 4D point sets.
#include "search/lifted_parts.hpp"

#include <algorithm>

#include "mortise/fourier/nfft.hpp"
#include "search/frequencies.hpp"
#include "search/real_products.hpp"

namespace mortise {
namespace {

// The series and the sums each get a share of the tolerance.
constexpr double kSeriesShare = 0.3, kSumShare = 0.1;
// What sums in single precision reach on every grid.
constexpr double kLeastSumTolerance = 1e-5;
constexpr double kFixedPartTolerance = 1e-5;

ConeSeries cone_of(const Knots& knots, const RadialTransform& transform, double k_max,
                   const std::vector<double>& offsets, const ComponentOptions& options) {
  const auto [least, most] = std::minmax_element(offsets.begin(), offsets.end());
  return fitted_cone(transform, std::min(k_max, options.low_pass.cutoff),
                     knots.points.row(3).minCoeff() + *least,
                     knots.points.row(3).maxCoeff() + *most,
                     std::max(1e-10, kSeriesShare * options.radius_tolerance));
}

Eigen::Matrix4Xd radius_first(const Eigen::Matrix4Xd& points) {
  Eigen::Matrix4Xd result(4, points.cols());
  result.row(0) = points.row(3);
  result.bottomRows<3>() = points.topRows<3>();
  return result;
}

// sum_i weights_i transform(k, r_i) exp(-2 pi i k.x_i): the slice r = 0 of the lifted body.
HalfSpectrum field_of(const Knots& knots, const Eigen::VectorXd& weights, const ConeSeries& cone,
                      const RigidMotion& motion, const std::array<int, 3>& size, double spacing,
                      const Frequencies& frequencies, const ComponentOptions& options) {
  Eigen::Matrix4Xd points = radius_first(knots.points);
  points.bottomRows<3>() = motion * Eigen::Matrix3Xd(knots.points.topRows<3>());
  const auto [nx, ny, nz] = size;
  Nfft4 nfft({cone.modes(), nx, ny, nz}, {cone.period(), nx * spacing, ny * spacing, nz * spacing},
             {.tolerance = std::min(kFixedPartTolerance, kSumShare * options.radius_tolerance),
              .weights = WeightKind::kReal,
              .expected_points = knots.size(),
              .threads = options.threads});
  const auto sums = nfft.transform(points, weights);
  Eigen::MatrixXcd series =
      Eigen::MatrixXcd::Zero(cone.modes(), static_cast<Eigen::Index>(frequencies.lengths.size()));
  for (Eigen::Index s = 0; s < series.cols(); ++s)
    if (options.low_pass(frequencies.lengths[s]) > 0.0)
      series.col(s) = cone.coefficients(frequencies.lengths[s]);
  HalfSpectrum field(frequencies.of_mode.size());
  for (int m = 0; m < cone.modes(); ++m)
    for (std::size_t n = 0; n < field.size(); ++n)
      field[n] += series(m, frequencies.of_mode[n]) * sums[m * field.size() + n];
  return field;
}

}  // namespace

LiftedParts make_lifted_parts(const std::vector<Channel>& channels,
                              const RigidMotion& search_from_fixed, const std::array<int, 3>& size,
                              double spacing, const ComponentOptions& options) {
  const Frequencies frequencies(size, spacing);
  const double k_max = frequencies.lengths.back();
  const double volume =
      static_cast<double>(size[0]) * size[1] * size[2] * spacing * spacing * spacing;
  LiftedParts result;
  result.tolerance = std::max(kLeastSumTolerance, kSumShare * options.radius_tolerance);
  for (const RealProduct& product : real_products(channels)) {
    const Channel& channel = *product.channel;
    const ConeSeries of_fixed =
        cone_of(channel.fixed, channel.fixed_transform, k_max, {0.0}, options);
    LiftedPart lifted{
        radius_first(channel.moving.points), product.moving.cast<float>(),
        cone_of(channel.moving, channel.moving_transform, k_max, options.offsets, options),
        field_of(channel.fixed, product.fixed, of_fixed, search_from_fixed, size, spacing,
                 frequencies, options)};
    const double factor = product.factor / volume;
    for (std::size_t n = 0; n < lifted.fixed.size(); ++n)
      lifted.fixed[n] *= factor * options.low_pass(frequencies.lengths[frequencies.of_mode[n]]);
    result.parts.push_back(std::move(lifted));
  }
  return result;
}

}  // namespace mortise
