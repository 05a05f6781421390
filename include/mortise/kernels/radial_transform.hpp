// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The type of a radial field's Fourier transform.
#pragma once

#include <functional>

namespace mortise {

/// Fourier transform of one knot's radial field at |w| = k (cycles per length unit) for radius r.
using RadialTransform = std::function<double(double k, double r)>;

}  // namespace mortise
