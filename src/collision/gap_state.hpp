// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What a gap function holds.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <mutex>
#include <numbers>
#include <vector>

#include "collision/gap_isa.hpp"
#include "collision/spectrum_table.hpp"
#include "mortise/collision/gap_function.hpp"

namespace mortise {

inline constexpr double kWholeTurn = 2.0 * std::numbers::pi;

struct GapFunction::State {
  BodyDensity moving;
  BoundingBall fixed_ball, moving_ball;
  double box = 0.0, bandwidth = 0.0, interpolation_error = 0.0;
  std::vector<Eigen::Vector3i> modes;  // half space, by rising |k|
  Eigen::MatrixXcd coefficients;       // modes x parts: F K / L^3, twice that but for mode 0
  InterpolationKernel kernel;
  std::vector<SpectrumTable> tables;  // of each part
  AlignedVector<float> frequency[3];
  std::vector<AlignedVector<float>> real, imag;
  const GapTable* table = nullptr;  // the sums for this processor
  // For early misses: sqrt(sum |K F|^2) over the modes from each block on (both of every pair), the
  // sum of |K F| over those before it, Int |rho_moving| and, once asked for, L^3 Int rho_moving^2.
  std::vector<double> tail, head;
  double moving_mass = 0.0;
  mutable double known_energy = 0.0;
  mutable std::once_flag energy_known;

  explicit State(double oversampling) : kernel(oversampling) {}

  static int reach_of(int half);  // largest |k| on an axis so that a ball holds this many pairs
  void order_modes(int half, const Eigen::MatrixXcd& spectrum, int side, const GapOptions& options);
  void pack();
  void measure_error(int threads);
  void measure_tails();
  /// L^3 Int rho_moving^2. @throws InputError unless the density is a real one of balls
  [[nodiscard]] double moving_energy() const;
  [[nodiscard]] GapJob job(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& t,
                           std::size_t part) const;
  [[nodiscard]] Eigen::Vector3d shift(const RigidMotion& pose) const {
    return pose * moving_ball.centre - fixed_ball.centre;
  }
  [[nodiscard]] int half_count(int asked) const {
    const int all = static_cast<int>(modes.size());
    return asked <= 0 ? all : std::min(all, (asked + 1) / 2);
  }
  [[nodiscard]] GapValue finish(const RigidMotion& pose, double value, const Eigen::Vector3d& slope,
                                const Eigen::Vector3d& spin) const;
};

/// Int rho^2 of real balls, by the pairs that meet.
[[nodiscard]] double ball_energy(const BodyDensity& density);

}  // namespace mortise
