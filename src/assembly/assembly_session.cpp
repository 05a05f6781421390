// SPDX-License-Identifier: GPL-3.0-or-later
// Energy and wrench from the gap function, and the damped motion along them.
#include "mortise/assembly/assembly_session.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "mortise/collision/gap_function.hpp"
#include "mortise/core/errors.hpp"
#include "mortise/core/rotation_vector.hpp"

namespace mortise {
namespace {

// Two purely imaginary densities i a and i b: Re(i a i b) = -a b, one real sum instead of two.
bool imaginary(const BodyDensity& density) { return (density.weights.real().array() == 0.0).all(); }

BodyDensity without_i(BodyDensity density) {
  density.weights = (density.weights.imag().cast<std::complex<double>>()).eval();
  return density;
}

}  // namespace

struct AssemblySession::State {
  GapFunction gap;
  double scale = 1.0;  // energy per value of the gap function
};

AssemblySession::AssemblySession(const BodyDensity& fixed, const BodyDensity& moving,
                                 const AssemblyOptions& options) {
  const GapOptions gap_options{.max_modes = options.modes,
                               .box = options.box,
                               .oversampling = options.oversampling,
                               .threads = options.threads};
  const bool both = imaginary(fixed) && imaginary(moving);
  state_ = std::make_unique<State>(
      State{both ? GapFunction(without_i(fixed), without_i(moving), gap_options)
                 : GapFunction(fixed, moving, gap_options)});
  state_->scale = both ? 1.0 : -1.0;
}

AssemblySession::~AssemblySession() = default;
AssemblySession::AssemblySession(AssemblySession&&) noexcept = default;
AssemblySession& AssemblySession::operator=(AssemblySession&&) noexcept = default;

Wrench AssemblySession::wrench(const RigidMotion& pose, int modes) const {
  const GapValue value = state_->gap(pose, modes);
  const double scale = state_->scale;
  return {scale * value.value, -scale * value.translation_gradient,
          -scale * value.rotation_gradient};
}

int AssemblySession::modes() const noexcept { return state_->gap.modes(); }
double AssemblySession::moving_radius() const noexcept { return state_->gap.moving_ball().radius; }
const Eigen::Vector3d& AssemblySession::moving_centre() const noexcept {
  return state_->gap.moving_ball().centre;
}
double AssemblySession::reach() const noexcept {
  return state_->gap.fixed_ball().radius + state_->gap.moving_ball().radius;
}

Rest follow(const AssemblySession& session, const RigidMotion& start,
            const FollowOptions& options) {
  if (!(options.step > 0.0))
    throw InputError("follow: step must be > 0, got " + std::to_string(options.step));
  if (options.max_steps < 1)
    throw InputError("follow: max_steps must be >= 1, got " + std::to_string(options.max_steps));
  if (!(options.tolerance > 0.0))
    throw InputError("follow: tolerance must be > 0, got " + std::to_string(options.tolerance));
  constexpr double kKept = 0.5, kLonger = 1.2;
  const double radius = session.moving_radius();
  const Eigen::Vector3d& centre = session.moving_centre();
  Rest rest{start, session.wrench(start), 0, false};
  double longest = options.step * radius;
  Eigen::Vector3d shift = Eigen::Vector3d::Zero(), turn = Eigen::Vector3d::Zero();  // the last move
  while (rest.steps < options.max_steps) {
    ++rest.steps;
    // The torque about the centre; moves are measured by what they do to the ball's surface.
    const Eigen::Vector3d arm = rest.pose.rotation * centre;
    Eigen::Vector3d push = rest.wrench.force;
    Eigen::Vector3d twist = (rest.wrench.torque - arm.cross(rest.wrench.force)) / (radius * radius);
    const double size = std::sqrt(push.squaredNorm() + radius * radius * twist.squaredNorm());
    if (size == 0.0) break;  // out of reach
    push *= longest / size;
    twist *= longest / size;
    const Eigen::Vector3d move = kKept * shift + (1.0 - kKept) * push;
    const Eigen::Vector3d spin = kKept * turn + (1.0 - kKept) * twist;
    RigidMotion next = rest.pose;
    next.rotation = canonical(rotation_from_vector(spin) * rest.pose.rotation);
    next.translation = rest.pose * centre + move - next.rotation * centre;
    const Wrench felt = session.wrench(next);
    if (felt.energy <= rest.wrench.energy) {
      rest.pose = next;
      rest.wrench = felt;
      shift = move;
      turn = spin;
      longest = std::min(longest * kLonger, options.step * radius);
    } else {
      shift.setZero();
      turn.setZero();
      longest *= 0.5;
    }
    if (longest < options.tolerance * radius) {
      rest.settled = true;
      break;
    }
  }
  return rest;
}

}  // namespace mortise
