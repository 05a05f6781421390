// SPDX-License-Identifier: GPL-3.0-or-later
// Transform and overlap volume of balls.
#include "mortise/kernels/ball.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mortise {

double ball_transform(double k, double r) {
  using std::numbers::pi;
  const double volume = 4.0 / 3.0 * pi * r * r * r;
  const double u = 2.0 * pi * k * r;
  // 3 (sin u - u cos u) / u^3; below 0.3 the difference cancels, so its Taylor series (error <
  // 1e-15) is used.
  if (std::abs(u) < 0.3) {
    const double s = u * u;
    return volume *
           (1.0 -
            s / 10.0 * (1.0 - s / 28.0 * (1.0 - s / 54.0 * (1.0 - s / 88.0 * (1.0 - s / 130.0)))));
  }
  return volume * 3.0 * (std::sin(u) - u * std::cos(u)) / (u * u * u);
}

double ball_overlap_volume(double a, double b, double d) {
  using std::numbers::pi;
  if (d >= a + b) return 0.0;
  const double small = std::min(a, b);
  if (d <= std::abs(a - b)) return 4.0 / 3.0 * pi * small * small * small;
  const double gap = a + b - d;
  return pi * gap * gap * (d * d + 2.0 * d * (a + b) - 3.0 * (a - b) * (a - b)) / (12.0 * d);
}

}  // namespace mortise
