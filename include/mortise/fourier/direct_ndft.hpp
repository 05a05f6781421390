// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Fourier sums over scattered points term by term: exact to rounding, for few points or few modes.
#pragma once

#include <Eigen/Core>
#include <array>

namespace mortise {

/// f^(k) = sum_i c_i exp(-2 pi i k.x_i / L) for all modes of a box, in the order and meaning of
/// Nfft (axis 0 slowest, k from -floor(n / 2)). Error about 1e-15 sqrt(N). Same bytes for any
/// number of threads.
/// @throws InputError if counts differ, something is not finite, a mode count < 1 or a side is not
/// > 0 Time O(N n) with n modes: one complex multiplication and addition each, no exponentials.
[[nodiscard]] Eigen::VectorXcd direct_ndft(const Eigen::Matrix3Xd& points,
                                           const Eigen::VectorXcd& weights,
                                           const std::array<int, 3>& modes,
                                           const std::array<double, 3>& box, int threads = 0);
[[nodiscard]] Eigen::VectorXcd direct_ndft(const Eigen::Matrix4Xd& points,
                                           const Eigen::VectorXcd& weights,
                                           const std::array<int, 4>& modes,
                                           const std::array<double, 4>& box, int threads = 0);

/// The same sum at any frequencies, D x M in cycles per length unit, D = 3 or 4 as for the points.
[[nodiscard]] Eigen::VectorXcd direct_ndft(const Eigen::MatrixXd& points,
                                           const Eigen::VectorXcd& weights,
                                           const Eigen::MatrixXd& frequencies, int threads = 0);

}  // namespace mortise
