// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A radial transform's dependence on the radius as a short sum of products: the compressed fourth
/// dimension.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "mortise/kernels/low_pass.hpp"
#include "mortise/kernels/radial_transform.hpp"

namespace mortise {

struct CompressRadiusOptions {
  double tolerance = 1e-4;  ///< largest error of any frequency, relative to the largest |phi(k, r +
                            ///< o)| of the same radius and offset; 1e-12 to 0.1
  std::vector<double> offsets = {0.0};  ///< added to every radius; r + o > 0
  LowPass low_pass = {};  ///< errors (and phi's largest value) at k count low_pass(k); the factors
                          ///< are those of phi itself
};

/// phi(k, r + o) ~ sum_q a_q^o(k) b_q(r) for 0 <= k <= k_max, the radii of a set or an interval and
/// a few offsets o. The b_q serve all offsets: weights that carry them are spread and transformed
/// once, whatever the number of offsets [SD, Sec. 4.2]. docs/math.md, "Compressed radius".
class CompressedRadius {
 public:
  [[nodiscard]] int terms() const noexcept { return static_cast<int>(from_radii_.cols()); }
  /// The largest error found, in the tolerance's measure, on a grid finer than the one fitted.
  [[nodiscard]] double measured_error() const noexcept { return measured_error_; }
  /// a_1^o(k) .. a_Q^o(k), 0 <= k <= k_max. @param offset  index into the options' offsets
  [[nodiscard]] Eigen::VectorXd frequency_factors(double k, std::size_t offset = 0) const;
  /// b_1(r) .. b_Q(r). One radius alone has the factor 1 exactly.
  /// @throws InputError unless r is one of the set, or within the interval (1e-9 of its ends aside)
  [[nodiscard]] Eigen::VectorXd radius_factors(double r) const;
  [[nodiscard]] const std::vector<double>& offsets() const noexcept { return offsets_; }

 private:
  friend CompressedRadius compress_radius(const RadialTransform&, double,
                                          const std::vector<double>&, const CompressRadiusOptions&);
  friend CompressedRadius compress_radius(const RadialTransform&, double, double, double,
                                          const CompressRadiusOptions&);
  CompressedRadius(const RadialTransform& transform, const CompressRadiusOptions& options)
      : transform_(transform), low_pass_(options.low_pass), offsets_(options.offsets) {}
  /// One fit on `k_count` frequencies and the radii, a set or nodes of an interval.
  void fit(int k_count, double k_max, double tolerance, const Eigen::VectorXd& radius_weights);

  RadialTransform transform_;
  LowPass low_pass_;
  std::vector<double> offsets_;
  std::vector<double> radii_;       // the set, or the interval's nodes; ascending
  double low_ = 0.0, high_ = 0.0;   // the interval, if low_ < high_
  Eigen::VectorXd frequencies_;     // nodes, offsets after each other
  Eigen::MatrixXd from_radii_;      // a_q^o(k) = sum_j phi(k, r_j + o) from_radii(j, q)
  Eigen::MatrixXd at_radii_;        // b_q(r_j), of a set
  Eigen::MatrixXd from_frequency_;  // of an interval: b_q(r) = sum_oi low_pass(k_i) phi(k_i, r + o)
                                    // from_frequency(oi, q)
  double measured_error_ = 0.0;
};

/// The fewest terms (a singular value decomposition of the table) whose measured error is within
/// the tolerance; double precision may end it earlier, near 1e-12: see measured_error().
/// @param radii  any number, in any order; many different ones are taken as their whole interval
/// @throws InputError unless 0 < k_max, there is a radius and an offset, all r + o > 0 and finite,
/// and the tolerance is in range
[[nodiscard]] CompressedRadius compress_radius(const RadialTransform& transform, double k_max,
                                               const std::vector<double>& radii,
                                               const CompressRadiusOptions& options = {});

/// For all radii from r_min to r_max: the singular functions continued off their nodes.
[[nodiscard]] CompressedRadius compress_radius(const RadialTransform& transform, double k_max,
                                               double r_min, double r_max,
                                               const CompressRadiusOptions& options = {});

}  // namespace mortise
