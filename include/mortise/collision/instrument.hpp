// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Instrument kernels of finite bandwidth and the cut-off with which they give back an obstacle.
#pragma once

#include <Eigen/Core>

namespace mortise {

/// How the Fourier coefficients of a kernel fall off.
enum class InstrumentShape {
  kFejer,           ///< linearly; nonnegative
  kHann,            ///< square of the raised cosine's; nonnegative
  kJackson,         ///< square of Fejer's; nonnegative
  kParksMcClellan,  ///< equal ripple in pass and stop band [FC, Sec. 5.4], shifted up to be
                    ///< nonnegative
};

/// w(x) = a_0 + 2 sum_k a_k cos(2 pi k x / L), k = 1 .. n, nonnegative; K(x) = prod_j w(x_j) [FC,
/// Eq. 27].
struct InstrumentKernel {
  double period = 0.0;           ///< L
  Eigen::VectorXd coefficients;  ///< a_0 .. a_n; a_0 L = Int w over a period = 1

  [[nodiscard]] int degree() const noexcept { return static_cast<int>(coefficients.size()) - 1; }
  [[nodiscard]] double value(double x) const;
  /// Int_0^x w.
  [[nodiscard]] double integral(double x) const;
  /// Int_0^x (x - y) w(y) dy.
  [[nodiscard]] double second_integral(double x) const;
  /// Multiplier of frequency w (d of them): prod_j L a_|k_j|; 0 beyond the degree.
  [[nodiscard]] double transform(const Eigen::VectorXd& w) const;
};

/// @param degree  n >= 1, highest frequency n / L
/// @throws InputError unless degree >= 1 and period > 0, or for kParksMcClellan (see below)
[[nodiscard]] InstrumentKernel instrument_kernel(InstrumentShape shape, int degree, double period);

/// The minimax kernel of this degree for given pass and stop bands, by Remez's exchange on
/// cos(2 pi x / L): |w - 1| <= r on [0, pass], |w| <= r on [stop, L / 2]; then shifted by r and
/// scaled.
/// @throws InputError unless degree >= 1 and 0 < pass < stop < period / 2
[[nodiscard]] InstrumentKernel parks_mcclellan(int degree, double period, double pass, double stop);

/// What a kernel promises: of bodies grown by x0 (in the maximum norm) the set V > threshold holds
/// the obstacle O of the bodies themselves and stays within O grown by `hausdorff` [FC, Sec. 6.1].
struct Cutoff {
  double threshold = 0.0;    ///< on V, in units of length^d
  double pass_radius = 0.0;  ///< x0
  double stop_radius = 0.0;  ///< x1
  double hausdorff = 0.0;    ///< 2 x0 + x1, maximum norm; infinite if there is no such x0 <= L / 4
};

/// The x0 and x1 with the least hausdorff such that
///
///   (2 Int_0^{2 x0} (2 x0 - y) w(y) dy)^d >= measure (1 - (2 Int_0^{x1} w)^d) = threshold.
///
/// The left side is what V is at least inside the obstacle: the cubes of radius x0 about a common
/// point overlap by prod_j (2 x0 - |y_j|) after a shift by y. ([FC, Lemma 3] has (2 x0)^d there,
/// which is too much; docs/math.md.) The right side is what is at most left of V where no point of
/// the obstacle is within 2 x0 + x1.
/// @param measure  at least the volume of the smaller grown body; 0 = (L / 2)^d, the most that fits
/// @throws InputError unless dimension is 1 to 3
[[nodiscard]] Cutoff estimate_cutoff(const InstrumentKernel& kernel, int dimension,
                                     double measure = 0.0);

/// The kernel of a shape and degree with the least error: for kParksMcClellan its bands are chosen
/// so.
struct Instrument {
  InstrumentKernel kernel;
  Cutoff cutoff;
};
[[nodiscard]] Instrument best_instrument(InstrumentShape shape, int degree, double period,
                                         int dimension, double measure = 0.0);

}  // namespace mortise
