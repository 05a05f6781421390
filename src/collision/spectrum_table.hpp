// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A body's spectrum on an oversampled grid, ready for interpolation at any frequency.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <vector>

#include "mortise/collision/body_density.hpp"
#include "mortise/fourier/aligned.hpp"
#include "mortise/fourier/spread_kernel.hpp"

namespace mortise {

/// The Kaiser-Bessel kernel of four samples' width for spectra sampled `oversampling` times per
/// Nyquist interval, and its pieces as GapJob::pieces wants them.
struct InterpolationKernel {
  explicit InterpolationKernel(double oversampling);

  SpreadKernel kernel;
  AlignedVector<float> pieces;
  std::vector<double> taps;  ///< of the filter that undoes the kernel
  /// |interpolated - exact| <= error_bound Int |rho|, at every frequency and whatever the body.
  double error_bound = 0.0;
};

/// Samples of rho^ at multiples of 1 / box, filtered so that the kernel's interpolant comes
/// nearest.
struct SpectrumTable {
  static constexpr int kMargin = 8;  ///< samples that only serve the filter, on each side

  int size = 0;  ///< per axis; frequency 0 at size / 2
  double box = 0.0;
  AlignedVector<float> samples;  ///< as GapJob::table wants them

  /// rho^ at frequency w by interpolation in double precision: a plain rewriting of the fast sum's.
  [[nodiscard]] std::complex<double> at(const Eigen::Vector3d& w, const SpreadKernel& kernel) const;
};

/// `spectrum`: even size^3 values at (i - size / 2) / box, first axis slowest; the outermost
/// kMargin are not kept.
[[nodiscard]] SpectrumTable make_table(const Eigen::Ref<const Eigen::VectorXcd>& spectrum, int size,
                                       double box, const InterpolationKernel& kernel);

}  // namespace mortise
