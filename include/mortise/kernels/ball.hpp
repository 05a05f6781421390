// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The indicator of a ball and its Fourier transform.
#pragma once

namespace mortise {

/// Fourier transform of the indicator of a ball of radius r at frequency |w| = k (cycles per length
/// unit): (sin u - u cos u) / (2 pi^2 k^3), u = 2 pi k r; its value at k = 0 is the ball's volume.
[[nodiscard]] double ball_transform(double k, double r);

/// Volume of the intersection of two balls of radii a and b whose centres are d apart.
[[nodiscard]] double ball_overlap_volume(double a, double b, double d);

}  // namespace mortise
