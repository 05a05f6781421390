// SPDX-License-Identifier: GPL-3.0-or-later
// Hessian-vector products of the gap function; derivation in docs/math.md.
#include <cmath>
#include <complex>

#include "collision/gap_state.hpp"
#include "mortise/core/rotation_vector.hpp"

namespace mortise {
namespace {

RigidMotion moved_along(const RigidMotion& pose, const Eigen::Vector3d& translation,
                        const Eigen::Vector3d& rotation, double s) {
  return {rotation_from_vector(s * rotation) * pose.rotation, pose.translation + s * translation};
}

}  // namespace

GapProduct GapFunction::hessian_product(const RigidMotion& pose, const Eigen::Vector3d& translation,
                                        const Eigen::Vector3d& rotation, int modes) const {
  const State& s = *state_;
  // No point of the moving body is faster; a phase of the highest mode changes by kPhase at most.
  // Shorter steps magnify the interpolation's error, longer ones miss the highest modes' curvature.
  constexpr double kPhase = 0.5;
  const Eigen::Vector3d arm = pose.rotation * s.moving_ball.centre;
  const double speed =
      (translation + rotation.cross(arm)).norm() + rotation.norm() * s.moving_ball.radius;
  const int half = s.half_count(modes);
  const double highest = s.modes[half - 1].cast<double>().norm() / s.box;
  if (!(speed > 0.0)) return {};
  const double step = kPhase / (kWholeTurn * std::max(highest, 1.0 / s.box) * speed);
  const GapValue after = (*this)(moved_along(pose, translation, rotation, step), modes);
  const GapValue before = (*this)(moved_along(pose, translation, rotation, -step), modes);
  return {(after.translation_gradient - before.translation_gradient) / (2.0 * step),
          (after.rotation_gradient - before.rotation_gradient) / (2.0 * step)};
}

GapProduct GapFunction::exact_hessian_product(const RigidMotion& pose,
                                              const Eigen::Vector3d& translation,
                                              const Eigen::Vector3d& rotation, int modes) const {
  const State& s = *state_;
  const Eigen::Vector3d t = s.shift(pose);
  if (!(t.norm() < s.fixed_ball.radius + s.moving_ball.radius)) return {};
  const Eigen::Matrix3d turn = pose.rotation.toRotationMatrix();
  const Eigen::Vector3d arm = turn * s.moving_ball.centre;
  const Eigen::Vector3d velocity = translation + rotation.cross(arm);  // of the ball's centre
  const std::complex<double> i_turn(0.0, -kWholeTurn);
  using Vector3cd = Eigen::Vector3cd;
  Eigen::Vector3d slope = Eigen::Vector3d::Zero(), slope_rate = slope, spin = slope,
                  spin_rate = slope;
  for (int i = 0; i < s.half_count(modes); ++i) {
    const Eigen::Vector3d k = s.modes[i].cast<double>(), w = k / s.box;
    const Eigen::Vector3d u = turn.transpose() * w;
    const Eigen::Vector3d u_rate = turn.transpose() * w.cross(rotation);  // across u
    const double omega = kWholeTurn * w.dot(velocity);
    const std::complex<double> phase = std::polar(1.0, kWholeTurn * w.dot(t));
    // Of each part: G, its rate, u x grad G, its rate; |u| stays, and so does the kernel.
    std::complex<double> g[2] = {}, g_rate[2] = {};
    Vector3cd a[2] = {Vector3cd::Zero(), Vector3cd::Zero()}, a_rate[2] = {a[0], a[1]};
    for (Eigen::Index j = 0; j < s.moving.size(); ++j) {
      const Eigen::Vector3d y = s.moving.points.col(j) - s.moving_ball.centre;
      const double shape =
          s.moving.radii.size() > 0 ? s.moving.kernel.transform(u.norm(), s.moving.radii[j]) : 1.0;
      const std::complex<double> e = std::polar(shape, -kWholeTurn * u.dot(y));
      const std::complex<double> rate = i_turn * u_rate.dot(y);
      const Eigen::Vector3d across = u.cross(y), across_rate = u_rate.cross(y);
      for (Eigen::Index p = 0; p < s.coefficients.cols(); ++p) {
        const std::complex<double> c =
            e * (p == 0 ? s.moving.weights[j].real() : s.moving.weights[j].imag());
        g[p] += c;
        g_rate[p] += rate * c;
        a[p] += (i_turn * c) * across.cast<std::complex<double>>();
        a_rate[p] += (i_turn * c) * (across_rate.cast<std::complex<double>>() +
                                     rate * across.cast<std::complex<double>>());
      }
    }
    for (Eigen::Index p = 0; p < s.coefficients.cols(); ++p) {
      const std::complex<double> product = s.coefficients(i, p) * phase;
      slope += k * (product * std::conj(g[p])).imag();
      slope_rate += k * (omega * (product * std::conj(g[p])).real() +
                         (product * std::conj(g_rate[p])).imag());
      const Vector3cd turned = product * a[p].conjugate();
      spin += turned.real();
      spin_rate += (product * a_rate[p].conjugate()).real() - omega * turned.imag();
    }
  }
  slope *= -kWholeTurn / s.box;
  slope_rate *= -kWholeTurn / s.box;
  const Eigen::Vector3d about_centre = rotation.cross(-(turn * spin)) - turn * spin_rate;
  return {slope_rate, about_centre + rotation.cross(arm).cross(slope) + arm.cross(slope_rate)};
}

}  // namespace mortise
