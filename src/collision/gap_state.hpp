// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What a gap function holds.
#pragma once

#include <Eigen/Core>
#include <algorithm>
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
  std::vector<Eigen::Vector3i> modes;  // half space, in order
  Eigen::MatrixXcd coefficients;       // modes x parts: F K / L^3, twice that but for mode 0
  InterpolationKernel kernel;
  std::vector<SpectrumTable> tables;  // of each part
  AlignedVector<float> frequency[3];
  std::vector<AlignedVector<float>> real, imag;
  const GapTable* table = nullptr;  // the sums for this processor
  // For early misses: sqrt(sum |K F|^2) over the modes from each block on (both of every pair), the
  // sum of |K F| over those before it, L^3 Int rho_moving^2 (negative: unknown) and Int
  // |rho_moving|.
  std::vector<double> tail, head;
  double moving_energy = -1.0, moving_mass = 0.0;

  explicit State(double oversampling) : kernel(oversampling) {}

  static int reach_of(int half);  // largest |k| on an axis so that a ball holds this many pairs
  void order_modes(int half, const Eigen::MatrixXcd& spectrum, int side, const GapOptions& options);
  void pack();
  void measure_error(int threads);
  void measure_tails();
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

/// Int rho^2 of real balls, pair by pair.
[[nodiscard]] double ball_energy(const BodyDensity& density);

}  // namespace mortise
