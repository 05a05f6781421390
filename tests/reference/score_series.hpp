// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The score of a placement as its truncated Fourier series, summed term by term, and as the exact
/// sum over pairs of balls.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "mortise/affinity/channel.hpp"
#include "mortise/core/rigid_motion.hpp"
#include "mortise/kernels/ball.hpp"

namespace mortise::reference {

/// Pair score of two balls under the double skin, from common volumes.
inline double double_skin_pair(double a, double b, double d, double offset, double penalty) {
  const double r0 = offset, l = penalty;
  return -l * l * ball_overlap_volume(a, b, d) + l * ball_overlap_volume(a + r0, b, d) +
         l * ball_overlap_volume(a, b + r0, d) - ball_overlap_volume(a + r0, b + r0, d);
}

/// sum_ij Re(-c_i d_j) pair(r_i, r_j, d_ij): knots' weights as given to double_skin_channel, real.
inline double double_skin_score(const Knots& fixed, const Knots& moving, const RigidMotion& pose,
                                double offset, double penalty) {
  double sum = 0.0;
  for (Eigen::Index j = 0; j < moving.size(); ++j) {
    const Eigen::Vector3d y = pose * moving.points.col(j).head<3>().eval();
    for (Eigen::Index i = 0; i < fixed.size(); ++i) {
      const double d = (fixed.points.col(i).head<3>() - y).norm();
      if (d < fixed.points(3, i) + moving.points(3, j) + 2.0 * offset)
        sum += fixed.weights[i].real() * moving.weights[j].real() *
               double_skin_pair(fixed.points(3, i), moving.points(3, j), d, offset, penalty);
    }
  }
  return sum;
}

/// s(t) = sum_k h(k) Re[A(k) conj(B(k)) e^(2 pi i k.t)] / volume over the modes of a grid, with A
/// and B summed over knots with one exponential each, h the Hann window; for channels with complex
/// weights A conj(B) stands for the two products of their real and imaginary parts.
class ScoreSeries {
 public:
  /// @param moving_turned  carries the moving input frame to the placement with t = 0
  ScoreSeries(const std::vector<Channel>& channels, const RigidMotion& search_from_fixed,
              const RigidMotion& moving_turned, const std::array<int, 3>& size, double spacing,
              double cutoff)
      : size_(size), spacing_(spacing) {
    const double volume = std::pow(spacing, 3) * size[0] * size[1] * size[2];
    for (int kx = -size[0] / 2; kx < size[0] / 2; ++kx)
      for (int ky = -size[1] / 2; ky < size[1] / 2; ++ky)
        for (int kz = 0; kz <= size[2] / 2; ++kz) {
          const Eigen::Vector3d w(kx / (size[0] * spacing), ky / (size[1] * spacing),
                                  kz / (size[2] * spacing));
          const double k = w.norm();
          std::complex<double> sum = 0.0;
          if (k < cutoff) {
            for (const Channel& c : channels) {
              const auto [are, aim] = field(c.fixed, c.fixed_transform, search_from_fixed, w, k);
              const auto [bre, bim] = field(c.moving, c.moving_transform, moving_turned, w, k);
              sum += c.weight * (are * std::conj(bre) - aim * std::conj(bim));
            }
            sum *= 0.5 * (1.0 + std::cos(std::numbers::pi * k / cutoff)) / volume;
          }
          // The other half space gives the conjugate; the two planes that it shares count once.
          terms_.push_back(kz == 0 || kz == size[2] / 2 ? sum : 2.0 * sum);
        }
  }

  [[nodiscard]] double operator()(const Eigen::Vector3d& t) const {
    std::array<std::vector<std::complex<double>>, 3> phase;
    for (int d = 0; d < 3; ++d)
      for (int k = d == 2 ? 0 : -size_[d] / 2; k <= (d == 2 ? size_[2] / 2 : size_[d] / 2 - 1); ++k)
        phase[d].push_back(
            std::polar(1.0, 2.0 * std::numbers::pi * k * t[d] / (size_[d] * spacing_)));
    double score = 0.0;
    const std::complex<double>* term = terms_.data();
    for (const auto& x : phase[0])
      for (const auto& y : phase[1]) {
        double re = 0.0, im = 0.0;  // of the sum over z
        for (const auto& z : phase[2]) {
          re += term->real() * z.real() - term->imag() * z.imag();
          im += term->real() * z.imag() + term->imag() * z.real();
          ++term;
        }
        const std::complex<double> xy = x * y;
        score += xy.real() * re - xy.imag() * im;
      }
    return score;
  }

 private:
  static std::pair<std::complex<double>, std::complex<double>> field(
      const Knots& knots, const RadialTransform& transform, const RigidMotion& motion,
      const Eigen::Vector3d& w, double k) {
    std::complex<double> re = 0.0, im = 0.0;
    for (Eigen::Index i = 0; i < knots.size(); ++i) {
      const Eigen::Vector3d x = motion * knots.points.col(i).head<3>().eval();
      const std::complex<double> e =
          std::polar(transform(k, knots.points(3, i)), -2.0 * std::numbers::pi * w.dot(x));
      re += knots.weights[i].real() * e;
      im += knots.weights[i].imag() * e;
    }
    return {re, im};
  }

  std::array<int, 3> size_;
  double spacing_;
  std::vector<std::complex<double>> terms_;
};

}  // namespace mortise::reference
