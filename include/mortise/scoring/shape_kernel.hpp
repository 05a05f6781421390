// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What a pair of knots adds to the shape score, by their distance.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "mortise/affinity/channel.hpp"
#include "mortise/kernels/compressed_radius.hpp"
#include "mortise/kernels/low_pass.hpp"

namespace mortise {

/// A function of distance that is 0 from `range` on, as a table over the squared distance.
struct TabulatedKernel {
  double range = 0.0;          ///< length unit of the bodies; > 0
  std::vector<double> values;  ///< at squared distances i range^2 / (n - 1), i < n; n >= 2

  /// Linear in the squared distance between entries. @param d_sq  >= 0
  [[nodiscard]] double operator()(double d_sq) const;
};

/// Score of two knots of a channel with weights 1 and given radii, low-passed:
///
///   K(d) = weight Int fixed_transform(k, r) moving_transform(k, r') low_pass(k) exp(2 pi i k.d)
///   d^3k
///
/// so that the channel scores Re sum_ij c_i d_j K(d_ij). K is cut 1.15 / cutoff past the channel's
/// range, tapered over the last 0.5 / cutoff: little of it reaches there (docs/math.md).
/// @throws InputError unless the low-pass ends at a finite cutoff > 0 and radii are > 0
[[nodiscard]] TabulatedKernel shape_kernel(const Channel& channel, double fixed_radius,
                                           double moving_radius, const LowPass& low_pass);

struct ShapeKernelsOptions {
  LowPass low_pass = {};                ///< with a finite cutoff > 0
  double radius_tolerance = 3e-3;       ///< as of the search; one radius a body has no error
  std::vector<double> offsets = {0.0};  ///< added to the moving radii
};

/// The pair score for all radii of a channel's knots,
///
///   K^o(d; r, r') ~ sum_q K^o_q(d; r) b_q(r'),     r of the fixed and r' of the moving body,
///
/// so that the fixed body's score at a point is Q sums over its knots (or Q maps), which a moving
/// knot weighs with its Q factors b_q, the same at all offsets o. One radius is one term with b = 1
/// and K_1 = shape_kernel().
class ShapeKernels {
 public:
  /// @throws InputError as shape_kernel() and compress_radius()
  explicit ShapeKernels(const Channel& channel, const ShapeKernelsOptions& options);

  [[nodiscard]] int terms() const noexcept { return moving_.terms(); }  ///< Q
  [[nodiscard]] double range() const noexcept { return range_; }        ///< of every kernel
  /// K^o_q(.; r) of a fixed radius. @param offset  index into the options' offsets
  [[nodiscard]] TabulatedKernel kernel(double fixed_radius, int term, std::size_t offset = 0) const;
  /// b_1 .. b_Q of a moving radius.
  [[nodiscard]] Eigen::VectorXd moving_factors(double radius) const {
    return moving_.radius_factors(radius);
  }
  /// The score of one pair at a squared distance.
  [[nodiscard]] double pair(double fixed_radius, double moving_radius, double d_sq,
                            std::size_t offset = 0) const;

 private:
  CompressedRadius fixed_, moving_;
  double range_;
  // Of offset o, moving term q and fixed term p at [(o Q + q) P + p].
  std::vector<TabulatedKernel> tables_;
};

}  // namespace mortise
