// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The kernel's dependence on the radius as a short sum of products.
#pragma once

#include <Eigen/Core>

#include "mortise/kernels/bump.hpp"
#include "mortise/kernels/low_pass.hpp"

namespace mortise {

struct CompressRadiusOptions {
  double tolerance = 1e-4;  ///< largest error of any frequency and radius, relative to the kernel's
                            ///< volume; 1e-12 to 0.1
  LowPass low_pass = {};    ///< folded into the frequency factors
};

/// low_pass(k) phi^(k; r) ~ sum_q a_q(k) b_q(r) for 0 <= k <= k_max and the radii of an interval.
class CompressedRadius {
 public:
  [[nodiscard]] int terms() const noexcept { return static_cast<int>(from_radius_.cols()); }
  /// The largest error found on a grid finer than the one fitted, relative to the volume phi^(0;
  /// r).
  [[nodiscard]] double measured_error() const noexcept { return measured_error_; }
  /// a_1(k) .. a_Q(k), 0 <= k <= k_max; of order 1.
  [[nodiscard]] Eigen::VectorXd frequency_factors(double k) const;
  /// b_1(r) .. b_Q(r), r of the interval; of order r^3.
  [[nodiscard]] Eigen::VectorXd radius_factors(double r) const;

 private:
  friend CompressedRadius compress_radius(const RadialKernel&, double, double, double,
                                          const CompressRadiusOptions&);
  CompressedRadius(const RadialKernel& kernel, const LowPass& low_pass)
      : kernel_(kernel), low_pass_(low_pass) {}

  RadialKernel kernel_;
  LowPass low_pass_;
  Eigen::VectorXd radii_, frequencies_;
  Eigen::MatrixXd from_radius_;  // a_q(k) = sum_j low_pass(k) Psi(k r_j) from_radius(j, q)
  Eigen::MatrixXd
      from_frequency_;  // b_q(r) = sum_i low_pass(k_i) phi^(k_i; r) from_frequency(i, q)
  double measured_error_ = 0.0;
};

/// The fewest terms (a singular value decomposition of the table, continued off its nodes) whose
/// measured error is within the tolerance.
/// @throws InputError unless 0 < k_max, 0 < r_min <= r_max and the tolerance is in range
[[nodiscard]] CompressedRadius compress_radius(const RadialKernel& kernel, double k_max,
                                               double r_min, double r_max,
                                               const CompressRadiusOptions& options = {});

}  // namespace mortise
