// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A part's distance on a grid: what a placement is judged by.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "mortise/parts/solid.hpp"

namespace mortise {

/// A solid's signed distance on a grid around it, read between the nodes by trilinear
/// interpolation.
class DistanceField {
 public:
  /// @param spacing  length unit; @param margin of the grid beyond the solid's bounds
  DistanceField(const Solid& solid, double spacing, double margin, int threads);

  /// What lies beyond the grid.
  static constexpr float kFar = 1e30F;

  /// Distance at x, kFar outside the grid; its gradient with it.
  [[nodiscard]] float at(const Eigen::Vector3f& x, Eigen::Vector3f& gradient) const {
    const Eigen::Vector3f cell = (x - low_) * inverse_;
    if (!(cell[0] >= 0.0F && cell[1] >= 0.0F && cell[2] >= 0.0F && cell[0] < last_[0] &&
          cell[1] < last_[1] && cell[2] < last_[2]))
      return kFar;
    const int i = static_cast<int>(cell[0]);
    const int j = static_cast<int>(cell[1]);
    const int k = static_cast<int>(cell[2]);
    const float u = cell[0] - static_cast<float>(i);
    const float v = cell[1] - static_cast<float>(j);
    const float w = cell[2] - static_cast<float>(k);
    const float* p =
        values_.data() + (static_cast<std::ptrdiff_t>(i) * size_[1] + j) * size_[2] + k;
    const float* q = p + step_x_;
    const float a00 = p[0] + w * (p[1] - p[0]);
    const float a01 = p[size_[2]] + w * (p[size_[2] + 1] - p[size_[2]]);
    const float a10 = q[0] + w * (q[1] - q[0]);
    const float a11 = q[size_[2]] + w * (q[size_[2] + 1] - q[size_[2]]);
    const float a0 = a00 + v * (a01 - a00);
    const float a1 = a10 + v * (a11 - a10);
    const float b00 = p[1] - p[0];
    const float b01 = p[size_[2] + 1] - p[size_[2]];
    const float b10 = q[1] - q[0];
    const float b11 = q[size_[2] + 1] - q[size_[2]];
    const float b0 = b00 + v * (b01 - b00);
    const float b1 = b10 + v * (b11 - b10);
    const float c0 = a01 - a00;
    const float c1 = a11 - a10;
    gradient[0] = (a1 - a0) * inverse_;
    gradient[1] = (c0 + u * (c1 - c0)) * inverse_;
    gradient[2] = (b0 + u * (b1 - b0)) * inverse_;
    return a0 + u * (a1 - a0);
  }

  [[nodiscard]] double spacing() const { return spacing_; }
  [[nodiscard]] const std::array<int, 3>& size() const { return size_; }
  [[nodiscard]] Eigen::Vector3d low() const { return low_.cast<double>(); }
  [[nodiscard]] Eigen::Vector3d high() const;

 private:
  Eigen::Vector3f low_;
  double spacing_;
  float inverse_;
  std::array<int, 3> size_;
  std::array<float, 3> last_;  // cells per axis
  std::ptrdiff_t step_x_ = 0;
  std::vector<float> values_;
};

}  // namespace mortise
