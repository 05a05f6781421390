// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// From an instrument kernel to a threshold with a guaranteed error of the obstacle.
#pragma once

#include "mortise/kernels/instrument.hpp"

namespace mortise {

/// What both bodies are fattened by before their spectra are truncated. Balls look the same from
/// every side, so their bound holds at every rotation; cubes are [FC]'s choice, for translations.
enum class Fattening { kBall, kCube };

struct CutoffOptions {
  int dimension = 3;  ///< 2 or 3
  Fattening fattening = Fattening::kBall;
  double largest_overlap = 0.0;  ///< largest common volume (area) of the two fattened
                                 ///< bodies, at most that of the smaller one;
                                 ///< 0 = (period / 2)^dimension, which [FC] takes
  int steps = 400;               ///< radii tried per quantity; >= 10. More tightens the
                                 ///< error found by about 1 / steps, all bounds hold
};

/// A certified collision test [FC, Sec. 6.1]. Let V be the gap function of the two bodies fattened
/// by x0, convolved with the kernel on every axis. At each relative translation t (and rotation,
/// with balls)
///   - if the bodies meet, V(t) >= threshold: V(t) < threshold is a proof that they do not;
///   - if the translational obstacle is farther from t than hausdorff_error, V(t) < threshold.
/// So {V >= threshold} holds the obstacle and lies within hausdorff_error of it. Distances are
/// Euclidean with balls, in the max norm with cubes. Both bodies together must fit into half a
/// period less hausdorff_error. The derivation is in docs/math.md.
struct Cutoff {
  double threshold = 0.0;  ///< volume (area) units
  double fattening = 0.0;  ///< x0, length
  double stop_radius =
      0.0;  ///< x1: what the kernel leaves beyond it cannot lift V to the threshold
  double hausdorff_error = 0.0;  ///< 2 x0 + x1, length
};

/// The cut-off with the least Hausdorff error for this kernel.
/// @throws InputError if an option is out of range, or the kernel's negative part is too large for
/// any threshold
[[nodiscard]] Cutoff estimate_cutoff(const InstrumentKernel& kernel,
                                     const CutoffOptions& options = {});

struct Instrument {
  InstrumentKernel kernel;
  Cutoff cutoff;
};

/// The best of Parks and McClellan's kernels of this degree (lifted, or squared from half the
/// degree, so that none is negative), over the width of the stop band, and of the windows.
/// @param degree  n >= 2 modes on each side of zero, 2 n + 1 per axis
[[nodiscard]] Instrument best_instrument(int degree, double period,
                                         const CutoffOptions& options = {});

}  // namespace mortise
