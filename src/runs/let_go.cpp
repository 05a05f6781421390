// SPDX-License-Identifier: GPL-3.0-or-later
// Random starts around a mate, let go.
#include "mortise/runs/let_go.hpp"

#include <numbers>
#include <random>
#include <string>

#include "mortise/core/errors.hpp"
#include "mortise/core/rotation_vector.hpp"
#include "mortise/metrics/placement.hpp"

namespace mortise {
namespace {

constexpr double kHomeShift = 0.02;                            // part of the radius
constexpr double kHomeAngle = 2.0 * std::numbers::pi / 180.0;  // radians
constexpr double kLargestDrift = 0.2;                          // part of the radius

void check(const LetGoOptions& o) {
  if (o.starts < 1)
    throw InputError("let go: starts must be >= 1, got " + std::to_string(o.starts));
  if (!(o.shift >= 0.0) || !(o.angle >= 0.0))
    throw InputError("let go: shift and angle must be >= 0, got " + std::to_string(o.shift) +
                     " and " + std::to_string(o.angle));
}

// Uniform in the unit ball.
class InBall {
 public:
  explicit InBall(std::uint64_t seed) : random_(seed) {}
  Eigen::Vector3d operator()() {
    Eigen::Vector3d p;
    do p << uniform(), uniform(), uniform();
    while (p.norm() > 1.0);
    return p;
  }

 private:
  double uniform() { return 2.0 * static_cast<double>(random_() >> 11) * 0x1.0p-53 - 1.0; }
  std::mt19937_64 random_;  // its numbers are fixed by the standard, unlike distributions'
};

}  // namespace

LetGoResult let_go(const AssemblySession& session, const TriangleMesh& moving,
                   const TrueMate& truth, const LetGoOptions& options,
                   const std::function<bool()>& continues) {
  check(options);
  const RigidMotion goal = truth.moving_in_fixed;
  const double radius = session.moving_radius();
  const Eigen::Vector3d& centre = session.moving_centre();
  LetGoResult result;
  result.mate = follow(session, goal, options.follow);
  const RigidMotion& rest_of_mate = result.mate.pose;
  const RigidMotion true_place = Placement(moving, truth).nearest(rest_of_mate);
  result.drift = (rest_of_mate * centre - true_place * centre).norm() / radius;
  result.holds = result.drift <= kLargestDrift;
  TrueMate at_rest = truth;
  at_rest.moving_in_fixed = rest_of_mate;
  const Placement placement(moving, at_rest);
  InBall in_ball(options.seed);
  for (int i = 0; i < options.starts; ++i) {
    const Eigen::Vector3d turn = options.angle * in_ball();
    if (continues && !continues()) break;
    RigidMotion start = goal;
    start.rotation = canonical(rotation_from_vector(turn) * goal.rotation);
    start.translation =
        goal * centre + options.shift * radius * in_ball() - start.rotation * centre;
    const RigidMotion end = follow(session, start, options.follow).pose;
    result.ends.push_back(end);
    const auto near = [&](const RigidMotion& place) {
      return (end * centre - place * centre).norm() < kHomeShift * radius &&
             rotation_angle(end.rotation, place.rotation) < kHomeAngle;
    };
    const bool unmoved = near(rest_of_mate);
    result.home_without_symmetries += unmoved ? 1 : 0;
    result.home += unmoved || near(placement.nearest(end)) ? 1 : 0;
  }
  return result;
}

}  // namespace mortise
