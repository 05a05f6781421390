// SPDX-License-Identifier: GPL-3.0-or-later
// Low-pass windows.
#include "mortise/kernels/low_pass.hpp"

#include <cmath>
#include <numbers>

namespace mortise {

double LowPass::operator()(double k) const {
  if (k >= cutoff) return 0.0;
  if (k <= pass || std::isinf(cutoff)) return 1.0;
  return 0.5 + 0.5 * std::cos(std::numbers::pi * (k - pass) / (cutoff - pass));
}

}  // namespace mortise
