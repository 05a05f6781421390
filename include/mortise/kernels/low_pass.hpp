// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Low-pass windows of |w|.
#pragma once

#include <limits>

namespace mortise {

/// 1 up to `pass`, then a cosine taper that reaches 0 with zero slope at `cutoff`; pass = 0 is the
/// Hann window. The default lets everything through.
struct LowPass {
  double cutoff = std::numeric_limits<double>::infinity();  ///< cycles per length unit, > pass
  double pass = 0.0;                                        ///< cycles per length unit, >= 0

  [[nodiscard]] double operator()(double k) const;
};

}  // namespace mortise
