// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The lifted kernel: a trimmed half-cone in four dimensions and its Fourier series along the
/// fourth axis.
#pragma once

#include <Eigen/Core>
#include <complex>

#include "mortise/kernels/bump.hpp"
#include "mortise/kernels/radial_transform.hpp"

namespace mortise {

/// Factor psi_alpha(1 - 2 r / height) by which trimming the cone weighs a ball of radius r [SD, Eq.
/// 11-13]: 1 at r = height / 2, 0 at r = 0 and r = height. (The paper prints 1 - 2 r / L with r in
/// (-L, 0), which lies outside psi's support: r means |r|.) Divide c_i by it to give every ball its
/// own weight back.
[[nodiscard]] double trimming_factor(double r, double height, double alpha);

/// Transform of the trimmed half-cone psi(|x| / |r|) psi_trim(1 - 2 |r| / L), -L < r < 0, at |w| =
/// k and fourth frequency eta: Int_0^L phi^(k; s) psi_trim(1 - 2 s / L) exp(+2 pi i eta s) ds, s =
/// -r.  Error below 1e-10 of its value at k = eta = 0 for trim_alpha in [1, 4].
[[nodiscard]] std::complex<double> cone_transform(const RadialKernel& kernel, double k, double eta,
                                                  double height, double trim_alpha);

/// phi^(k; r) trim(r) = sum_m g_m(k) exp(-2 pi i m r / period), m = -floor(M / 2) .. ceil(M / 2)
/// - 1.
///
/// With the 4D sums F(w, m) over knots (x_i, r_i) the slice with all radii r0 larger is
/// f^(w) = sum_m g_m(|w|) exp(-2 pi i m r0 / period) F(w, m)  [SD, Eq. 24-25 and Sec. 3.2].
class ConeSeries {
 public:
  [[nodiscard]] int modes() const noexcept { return static_cast<int>(to_modes_.rows()); }
  [[nodiscard]] double period() const noexcept { return period_; }
  /// By what a ball of radius r comes out weighted; 1 for a fitted cone on its radii.
  [[nodiscard]] double trim(double r) const;
  [[nodiscard]] Eigen::VectorXcd coefficients(double k) const;  ///< g_m(k), M of them

 private:
  friend ConeSeries trimmed_cone(const RadialKernel&, double, double, int);
  friend ConeSeries fitted_cone(const RadialTransform&, double, double, double, double);
  explicit ConeSeries(const RadialTransform& transform) : transform_(transform) {}

  RadialTransform transform_;
  double period_ = 0.0;
  double trim_alpha_ = 0.0;                   // 0: fitted
  Eigen::VectorXd radii_;                     // where phi^(k; .) is sampled
  Eigen::MatrixXcd from_samples_, to_modes_;  // g = to_modes from_samples phi^
};

/// The paper's cone of the given height, its transform cut off after `modes` terms; the period is
/// the height.
[[nodiscard]] ConeSeries trimmed_cone(const RadialKernel& kernel, double height, double trim_alpha,
                                      int modes);

/// The cone as it may be altered where no slice looks: the shortest series of period 2.5 (r_max -
/// r_min) that gives any radial transform phi^(k; r) for k <= k_max and r_min <= r <= r_max, with
/// error <= tolerance of the largest |phi^(k; r_max)|, a ball's volume; no weighting of balls.
/// @throws InputError unless 0 < k_max, 0 < r_min <= r_max, 1e-10 <= tolerance <= 0.1
[[nodiscard]] ConeSeries fitted_cone(const RadialTransform& transform, double k_max, double r_min,
                                     double r_max, double tolerance);

}  // namespace mortise
