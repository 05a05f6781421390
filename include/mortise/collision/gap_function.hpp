// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The gap function of two bodies and its gradient on SE(3) from a truncated Fourier series.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <span>

#include "mortise/collision/body_density.hpp"
#include "mortise/core/rigid_motion.hpp"

namespace mortise {

struct GapOptions {
  int max_modes = 4096;  ///< modes kept, those of least |w|, w and -w counted as two; >= 1
  double box = 0.0;      ///< period L, length unit; 0 = the least: twice the sum of the radii
  double oversampling =
      2.0;  ///< samples of the moving body's spectrum per Nyquist interval; 1.5 to 4
  /// Multiplies the product of the spectra: the instrument kernel K^(w) [FC, Eq. 28]; empty = 1.
  std::function<double(const Eigen::Vector3d& w)> window = {};
  int threads = 0;  ///< for the making; 0 = all cores; never changes the result
};

/// Value and gradient at one pose.
struct GapValue {
  double value = 0.0;
  /// d V / d t, fixed frame.
  Eigen::Vector3d translation_gradient = Eigen::Vector3d::Zero();
  /// d V / d e at e = 0 of the pose with rotation exp([e]x) R and the same t: a torque about the
  /// moving body's origin, fixed frame.
  Eigen::Vector3d rotation_gradient = Eigen::Vector3d::Zero();
};

/// V(R, t) = Re Int rho_fixed(x) rho_moving(R^T (x - t)) dx, smoothed by the window [FC, Eq. 30-32;
/// SD, Eq. 50; HA, Eq. 7, 10-12]; derivation in docs/math.md:
///
///   V = L^-3 Re sum_w K^(w) F(w) conj(G(R^T w)) exp(2 pi i w.t), w = k / L, over the modes kept.
///
/// Immutable once made; one object serves any number of threads. Where the bodies' bounding balls
/// do not meet value and gradient are 0. Every call with a motion throws InputError unless it is
/// finite with a unit quaternion.
class GapFunction {
 public:
  /// @throws InputError on bad densities or options, or if one body is real and the other not
  /// Time: one NFFT per body, plus a check of the interpolation, at most 2e7 terms.
  GapFunction(const BodyDensity& fixed, const BodyDensity& moving, const GapOptions& options = {});
  ~GapFunction();
  GapFunction(GapFunction&&) noexcept;
  GapFunction& operator=(GapFunction&&) noexcept;

  /// The value and all six derivatives from the first `modes` modes (0 = all) in single precision,
  /// the moving spectrum by interpolation. No allocation. Time O(modes), about 4 ns each.
  [[nodiscard]] GapValue operator()(const RigidMotion& moving_in_fixed, int modes = 0) const;

  /// The same at many poses. @throws InputError if the counts differ
  void evaluate(std::span<const RigidMotion> poses, std::span<GapValue> values, int modes = 0,
                int threads = 0) const;

  /// The same in double precision, the moving spectrum summed term by term: the reference. Time
  /// O(modes N), N points of the moving density.
  [[nodiscard]] GapValue exact(const RigidMotion& moving_in_fixed, int modes = 0) const;

  [[nodiscard]] int modes() const noexcept;         ///< modes kept, <= max_modes
  [[nodiscard]] double box() const noexcept;        ///< L
  [[nodiscard]] double bandwidth() const noexcept;  ///< largest |w| kept, cycles per length unit
  [[nodiscard]] const BoundingBall& fixed_ball() const noexcept;   ///< fixed frame
  [[nodiscard]] const BoundingBall& moving_ball() const noexcept;  ///< moving frame
  /// Largest error of the interpolated spectrum found at places between its samples, relative to
  /// the integral of |rho_moving|.
  [[nodiscard]] double interpolation_error() const noexcept;
  /// The value differs from that with exact spectra by no more than this; for real densities.
  [[nodiscard]] double sum_error_bound() const noexcept;

  /// Early miss [FC, Sec. 6.4]: sums modes only until value and bound on all that is left out fall
  /// below `threshold`.
  struct Rejection {
    bool rejected =
        false;      ///< V, exactly interpolated and with all modes kept, is below the threshold
    int modes = 0;  ///< summed
    double bound = 0.0;  ///< the last upper bound on V
  };
  /// The rest is at most L^-3 times the root of sum |K F|^2 over the rest times the root of L^3 Int
  /// rho_moving^2 - sum |G(R^T w)|^2 over the modes summed, both over the whole space (twice the
  /// half of Eq. 30); the second is Parseval's and holds at every rotation. Interpolation errors
  /// are bounded and added. For real densities of balls only. @throws InputError otherwise. The
  /// first call works out Int rho_moving^2.
  [[nodiscard]] Rejection reject(const RigidMotion& moving_in_fixed, double threshold) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace mortise
