// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A client of Mortise's C interface for a physics engine: header only, standard library only.
#pragma once

#include <array>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <vector>

#include "mortise/assembly/mortise_wrench.h"

namespace mortise_client {

struct Mesh {
  std::vector<double> vertices;  ///< 3 per vertex
  std::vector<int> triangles;    ///< 3 per triangle

  [[nodiscard]] mortise_mesh view() const {
    return {vertices.data(), static_cast<long>(vertices.size() / 3), triangles.data(),
            static_cast<long>(triangles.size() / 3)};
  }
};

/// The guidance between two parts.
class Guidance {
 public:
  Guidance(const Mesh& fixed, const Mesh& moving, const mortise_session_options& options = {}) {
    const mortise_mesh a = fixed.view(), b = moving.view();
    mortise_session* session = nullptr;
    check(mortise_session_create(&a, &b, &options, &session));
    session_.reset(session);
    check(mortise_session_moving_ball(session, centre_.data(), &radius_));
  }

  [[nodiscard]] mortise_wrench wrench(const mortise_pose& pose) const {
    mortise_wrench result;
    check(mortise_session_wrench(session_.get(), &pose, 0, &result));
    return result;
  }
  /// Of a ball around the moving part, its own frame.
  [[nodiscard]] double radius() const { return radius_; }
  [[nodiscard]] const std::array<double, 3>& centre() const { return centre_; }

 private:
  struct Free {
    void operator()(mortise_session* session) const { mortise_session_free(session); }
  };
  static void check(int code) {
    if (code != 0) throw std::runtime_error(mortise_last_error());
  }

  std::unique_ptr<mortise_session, Free> session_;
  std::array<double, 3> centre_ = {};
  double radius_ = 0.0;
};

/// One rigid body of an engine, as simple as can be: a ball's mass and inertia about `centre`,
/// linear damping, semi-implicit Euler. Force and torque act on it times `stiffness`.
struct Body {
  mortise_pose pose = {{1.0, 0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}};
  std::array<double, 3> velocity = {}, spin = {};  ///< of the centre
  std::array<double, 3> centre = {};               ///< of mass, the body's own frame
  double mass = 1.0, radius = 1.0, damping = 4.0, stiffness = 1.0;

  /// From the body's origin to its centre, the world's axes.
  [[nodiscard]] std::array<double, 3> arm() const {
    const double* q = pose.rotation;
    const std::array<double, 3> v = {q[1], q[2], q[3]};
    const std::array<double, 3> once = cross(v, centre);  // c + 2 v x (v x c + w c)
    std::array<double, 3> result = {};
    for (int d = 0; d < 3; ++d) result[d] = once[d] + q[0] * centre[d];
    result = cross(v, result);
    for (int d = 0; d < 3; ++d) result[d] = centre[d] + 2.0 * result[d];
    return result;
  }

  void step(const mortise_wrench& wrench, double dt) {
    const double inertia = 0.4 * mass * radius * radius;
    const std::array<double, 3> before = arm();
    // The wrench's torque is about the origin, the body turns about its centre.
    const std::array<double, 3> shift =
        cross(before, {wrench.force[0], wrench.force[1], wrench.force[2]});
    for (int d = 0; d < 3; ++d) {
      velocity[d] += dt * (stiffness * wrench.force[d] / mass - damping * velocity[d]);
      spin[d] += dt * (stiffness * (wrench.torque[d] - shift[d]) / inertia - damping * spin[d]);
    }
    // q' = (0, spin) q / 2.
    const double* q = pose.rotation;
    const std::array<double, 4> rate = {-spin[0] * q[1] - spin[1] * q[2] - spin[2] * q[3],
                                        spin[0] * q[0] + spin[1] * q[3] - spin[2] * q[2],
                                        spin[1] * q[0] + spin[2] * q[1] - spin[0] * q[3],
                                        spin[2] * q[0] + spin[0] * q[2] - spin[1] * q[1]};
    double norm = 0.0;
    for (int d = 0; d < 4; ++d) {
      pose.rotation[d] += 0.5 * dt * rate[d];
      norm += pose.rotation[d] * pose.rotation[d];
    }
    for (double& x : pose.rotation) x /= std::sqrt(norm);
    const std::array<double, 3> after = arm();
    for (int d = 0; d < 3; ++d) pose.translation[d] += dt * velocity[d] + before[d] - after[d];
  }

 private:
  static std::array<double, 3> cross(const std::array<double, 3>& a,
                                     const std::array<double, 3>& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  }
};

}  // namespace mortise_client
