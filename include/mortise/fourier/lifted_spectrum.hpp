// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Spectra of unions of balls of unequal radii and of their offsets: slices of the lifted shape.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "mortise/core/knots.hpp"
#include "mortise/kernels/bump.hpp"

namespace mortise {

/// How to sum; all three agree to the tolerance.
enum class LiftedForm {
  kDirect4d,    ///< the 4D sum term by term, then over the fourth frequency with the cone's series
  kNfft4d,      ///< the same with the 4D NFFT, as in the paper
  kCompressed,  ///< a few 3D NFFTs, phi^(k; r + r0) ~ sum_q a_q(k; r0) b_q(r), for all slices at
                ///< once
};

struct LiftedOptions {
  std::vector<double> offsets = {0.0};  ///< r0 per slice, added to every radius; >= 0, length unit
  double tolerance = 1e-4;  ///< relative l2 error over the modes of a slice; 1e-8 to 0.1
  LiftedForm form = LiftedForm::kCompressed;
  int threads = 0;  ///< 0 = all cores; never changes the result
};

/// f^(w) = sum_i c_i exp(-2 pi i w.x_i) phi^(|w|; r_i + r0) at w = k / L, one column per offset
/// [SD, Sec. 2.5 and 4.2].
///
/// Modes ordered as by Nfft. @throws InputError on bad knots, modes, box or options
[[nodiscard]] Eigen::MatrixXcd lifted_spectrum(const Knots& knots, const RadialKernel& kernel,
                                               const std::array<int, 3>& modes,
                                               const std::array<double, 3>& box,
                                               const LiftedOptions& options = {});

}  // namespace mortise
