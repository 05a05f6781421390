// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Geometric energy, force and torque of two parts at haptic rate, and a part that follows them.
#pragma once

#include <Eigen/Core>
#include <memory>

#include "mortise/collision/body_density.hpp"
#include "mortise/core/rigid_motion.hpp"

namespace mortise {

struct AssemblyOptions {
  int modes = 4096;           ///< m', w and -w counted as two: more make contact harder; >= 1
  double oversampling = 2.0;  ///< see GapOptions
  double box = 0.0;           ///< see GapOptions
  int threads = 0;            ///< for the making; 0 = all cores
};

/// What the moving part feels.
struct Wrench {
  double energy = 0.0;                              ///< densities squared times volume
  Eigen::Vector3d force = Eigen::Vector3d::Zero();  ///< -dE/dt, fixed frame, per length unit
  Eigen::Vector3d torque =
      Eigen::Vector3d::Zero();  ///< about the moving part's origin, fixed frame
};

/// E(R, t) = -Re Int rho_fixed(x) rho_moving(R^T (x - t)) dx from the m' modes of least |w|, with
/// force and torque its gradient [HA, Eq. 7-12]; made once per pair of parts. Immutable; serves any
/// number of threads.
class AssemblySession {
 public:
  /// @throws InputError on bad densities or options
  AssemblySession(const BodyDensity& fixed, const BodyDensity& moving,
                  const AssemblyOptions& options = {});
  ~AssemblySession();
  AssemblySession(AssemblySession&&) noexcept;
  AssemblySession& operator=(AssemblySession&&) noexcept;

  /// No allocation, no lock. @param modes  only the first so many; 0 = all
  /// @throws InputError unless the motion is finite with a unit quaternion
  [[nodiscard]] Wrench wrench(const RigidMotion& moving_in_fixed, int modes = 0) const;

  [[nodiscard]] int modes() const noexcept;
  [[nodiscard]] double moving_radius() const noexcept;  ///< of the ball around the moving part
  [[nodiscard]] const Eigen::Vector3d& moving_centre()
      const noexcept;  ///< its centre, moving frame
  [[nodiscard]] double reach()
      const noexcept;  ///< farther apart than this the centres feel nothing

 private:
  struct State;
  std::unique_ptr<State> state_;
};

struct FollowOptions {
  double step = 0.02;    ///< longest move per step at first, part of the moving part's radius; > 0
  int max_steps = 2000;  ///< >= 1
  double tolerance = 1e-4;  ///< settled when moves are shorter, part of the radius; > 0
};

/// Where a part let go comes to rest.
struct Rest {
  RigidMotion pose;
  Wrench wrench;
  int steps = 0;
  bool settled = false;
};

/// Lets the moving part follow force and torque against heavy damping: each step goes along (force,
/// torque / radius^2) about its centre, half of the last move kept, and is taken back and halved
/// where the energy would rise.
/// @throws InputError if an option is out of range
[[nodiscard]] Rest follow(const AssemblySession& session, const RigidMotion& start,
                          const FollowOptions& options = {});

}  // namespace mortise
