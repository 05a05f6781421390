// SPDX-License-Identifier: GPL-3.0-or-later
// Channels taken apart into the real point sets that the search transforms.
#include "search/components.hpp"

#include <algorithm>
#include <map>

#include "mortise/core/threads.hpp"
#include "mortise/fourier/nfft.hpp"
#include "mortise/kernels/compressed_radius.hpp"
#include "search/real_products.hpp"

namespace mortise {
namespace {

// Far below what single precision and the coarse grid leave.
constexpr double kFixedTolerance = 1e-5;

// a_q(k) of every length, terms x lengths; 0 where nothing passes.
Eigen::MatrixXd factors_of(const CompressedRadius& compressed, std::size_t offset,
                           const Frequencies& frequencies, const ComponentOptions& options) {
  const std::vector<double>& lengths = frequencies.lengths;
  Eigen::MatrixXd result =
      Eigen::MatrixXd::Zero(compressed.terms(), static_cast<Eigen::Index>(lengths.size()));
  constexpr std::size_t kPiece = 1024;
  parallel_for((lengths.size() + kPiece - 1) / kPiece, options.threads,
               [&](std::size_t piece, int) {
                 const std::size_t end = std::min(lengths.size(), (piece + 1) * kPiece);
                 for (std::size_t n = piece * kPiece; n < end; ++n)
                   if (options.low_pass(lengths[n]) > 0.0)
                     result.col(static_cast<Eigen::Index>(n)) =
                         compressed.frequency_factors(lengths[n], offset);
               });
  return result;
}

CompressedRadius compress(const Knots& knots, const RadialTransform& transform, double k_max,
                          const std::vector<double>& offsets, const ComponentOptions& options) {
  return compress_radius(
      transform, k_max, std::vector<double>(knots.points.row(3).begin(), knots.points.row(3).end()),
      {.tolerance = options.radius_tolerance, .offsets = offsets, .low_pass = options.low_pass});
}

// weights_i b_q(r_i): one column per term.
Eigen::MatrixXd shares_of(const Knots& knots, const Eigen::VectorXd& weights,
                          const CompressedRadius& compressed) {
  std::map<double, Eigen::VectorXd> factors;
  Eigen::MatrixXd shares(knots.size(), compressed.terms());
  for (Eigen::Index i = 0; i < knots.size(); ++i) {
    const auto [entry, is_new] = factors.try_emplace(knots.points(3, i));
    if (is_new) entry->second = compressed.radius_factors(entry->first);
    shares.row(i) = weights[i] * entry->second.transpose();
  }
  return shares;
}

}  // namespace

Components make_components(const std::vector<Channel>& channels,
                           const RigidMotion& search_from_fixed, const std::array<int, 3>& size,
                           double spacing, const ComponentOptions& options) {
  const auto [nx, ny, nz] = size;
  const Frequencies frequencies(size, spacing);
  const double k_max = frequencies.lengths.back();
  Nfft3 nfft(
      size, {nx * spacing, ny * spacing, nz * spacing},
      {.tolerance = kFixedTolerance, .weights = WeightKind::kReal, .threads = options.threads});
  const double volume = static_cast<double>(nx) * ny * nz * spacing * spacing * spacing;

  // Channels often share their centres (all atoms): equal centres are spread once per component.
  Components result;
  std::map<std::array<double, 3>, Eigen::Index> index;
  for (const Channel& channel : channels)
    for (Eigen::Index j = 0; j < channel.moving.size(); ++j)
      index.emplace(std::array<double, 3>{channel.moving.points(0, j), channel.moving.points(1, j),
                                          channel.moving.points(2, j)},
                    0);
  result.points.resize(3, static_cast<Eigen::Index>(index.size()));
  Eigen::Index next = 0;
  for (auto& [centre, i] : index) {
    result.points.col(next) << centre[0], centre[1], centre[2];
    i = next++;
  }

  for (const RealProduct& product : real_products(channels)) {
    const Channel& channel = *product.channel;
    // sum_i weights_i transform(k, r_i) exp(-2 pi i k.x_i) over all modes.
    const CompressedRadius of_fixed =
        compress(channel.fixed, channel.fixed_transform, k_max, {0.0}, options);
    const Eigen::Matrix3Xd points =
        search_from_fixed * Eigen::Matrix3Xd(channel.fixed.points.topRows<3>());
    const Eigen::MatrixXd fixed_shares = shares_of(channel.fixed, product.fixed, of_fixed);
    const Eigen::MatrixXd fixed_factors = factors_of(of_fixed, 0, frequencies, options);
    HalfSpectrum field(frequencies.of_mode.size());
    for (Eigen::Index q = 0; q < fixed_shares.cols(); ++q) {
      const auto modes = nfft.transform(points, Eigen::VectorXd(fixed_shares.col(q)));
      for (std::size_t n = 0; n < field.size(); ++n)
        field[n] += modes[n] * fixed_factors(q, frequencies.of_mode[n]);
    }

    const double factor = product.factor / volume;  // 1 / volume is the inverse transform's
    const CompressedRadius of_moving =
        compress(channel.moving, channel.moving_transform, k_max, options.offsets, options);
    const Eigen::MatrixXd shares = shares_of(channel.moving, product.moving, of_moving);
    std::vector<Eigen::MatrixXd> factors;
    for (std::size_t o = 0; o < options.offsets.size(); ++o)
      factors.push_back(factors_of(of_moving, o, frequencies, options));
    for (Eigen::Index q = 0; q < shares.cols(); ++q) {
      Component component{Eigen::VectorXf::Zero(result.points.cols()), {}};
      for (Eigen::Index j = 0; j < channel.moving.size(); ++j)
        component.weights[index.at({channel.moving.points(0, j), channel.moving.points(1, j),
                                    channel.moving.points(2, j)})] +=
            static_cast<float>(shares(j, q));
      for (const Eigen::MatrixXd& of_offset : factors) {
        HalfSpectrum& spectrum = component.spectra.emplace_back(field);
        for (std::size_t n = 0; n < spectrum.size(); ++n)
          spectrum[n] *= factor * of_offset(q, frequencies.of_mode[n]);
        for (std::size_t n = 0; n < spectrum.size(); ++n)
          spectrum[n] *= options.low_pass(frequencies.lengths[frequencies.of_mode[n]]);
      }
      result.parts.push_back(std::move(component));
    }
  }
  return result;
}

}  // namespace mortise
