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
  [[nodiscard]] double radius() const { return radius_; }

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

/// One rigid body of an engine, as simple as can be: a ball's inertia, linear damping,
/// semi-implicit Euler. Force and torque act on it times `stiffness`.
struct Body {
  mortise_pose pose = {{1.0, 0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}};
  std::array<double, 3> velocity = {}, spin = {};
  double mass = 1.0, radius = 1.0, damping = 4.0, stiffness = 1.0;

  void step(const mortise_wrench& wrench, double dt) {
    const double inertia = 0.4 * mass * radius * radius;
    for (int d = 0; d < 3; ++d) {
      velocity[d] += dt * (stiffness * wrench.force[d] / mass - damping * velocity[d]);
      spin[d] += dt * (stiffness * wrench.torque[d] / inertia - damping * spin[d]);
      pose.translation[d] += dt * velocity[d];
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
  }
};

}  // namespace mortise_client
