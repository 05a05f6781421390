// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The skeletal density's surface integral by the triangle tree, compiled once per instruction set.
/// Types only.
#pragma once

#include <cstddef>

#include "parts/triangle_tree.hpp"

namespace mortise {

constexpr int kSkeletalTerms = 24;
constexpr int kSkeletalNodes = 8;

/// The kernel (1 + it)^-2 g_sigma(t - 1) of t = distance / nearest distance, and how far to go.
struct SkeletalKernel {
  double sigma;
  double longest;  ///< t beyond which the kernel counts as nothing
  /// The largest error, as a share of the peak, with which a cluster counts by its moments and a
  /// triangle by the rule of degree 2; the error of those that count by the rule of degree 5
  /// instead.
  double allowed, allowed_degree_five;
  /// Int_t^longest of the kernel, as Chebyshev series in the variable (1 / t - middle) / half.
  double middle, half;
  double tail_real[kSkeletalTerms], tail_imag[kSkeletalTerms];
  double nodes[kSkeletalNodes], weights[kSkeletalNodes];  ///< Gauss's rule on [0, 1]
};

struct SkeletalTable {
  /// For each point (x, y, z one after the other) at distance > 0 from the mesh: real and imaginary
  /// part of Int (1 + it)^-2 g_sigma(t - 1) (x - p).n / |x - p|^3 t^2 dA over the mesh, where
  /// t = |x - p| / distance.
  void (*integrate)(const TreeView& tree, const SkeletalKernel& kernel, const double* points,
                    const double* distances, std::ptrdiff_t count, double* real_imag);
};

/// The copy for this processor.
[[nodiscard]] const SkeletalTable& skeletal_table();

}  // namespace mortise
