// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// An instrument kernel that is the same in all directions, for bodies that turn.
#pragma once

namespace mortise {

/// K(x) >= 0 with Int K = 1 in three dimensions and no frequency above `bandwidth`: the square of
/// the kernel whose transform is cos^2(pi k / B) on k < B / 2. Falls off as |x|^-6.
class RadialInstrument {
 public:
  /// @throws InputError unless bandwidth > 0 (cycles per length unit)
  explicit RadialInstrument(double bandwidth);

  [[nodiscard]] double bandwidth() const noexcept { return bandwidth_; }
  /// K^(k) within kTransformError; 1 at 0, 0 from the bandwidth on.
  [[nodiscard]] double transform(double k) const;
  static constexpr double kTransformError = 5e-7;
  /// Int of K over |x| >= r, from above.
  [[nodiscard]] double outside(double r) const;
  /// Int of K(x) times the overlap of two balls of radius r whose centres are x apart.
  [[nodiscard]] double lens(double r) const;

 private:
  double bandwidth_;
};

}  // namespace mortise
