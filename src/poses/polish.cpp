// SPDX-License-Identifier: GPL-3.0-or-later
// BFGS on SE(3), one pose at a time.
#include "mortise/poses/polish.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "mortise/core/errors.hpp"
#include "mortise/core/threads.hpp"
#include "scoring/by_place.hpp"

namespace mortise {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

void check(const PolishBody& body, const PolishOptions& o) {
  const auto refuse = [](const std::string& what) { throw InputError("polish: " + what); };
  if (!(body.gyration > 0.0) || !std::isfinite(body.gyration) || !body.centre.allFinite())
    refuse("the body's gyration must be > 0 and finite and its centre finite, got " +
           std::to_string(body.gyration));
  if (o.evaluations < 1) refuse("evaluations must be >= 1, got " + std::to_string(o.evaluations));
  for (const auto& [value, name] :
       {std::pair{o.first_step, "first_step"}, std::pair{o.longest_step, "longest_step"},
        std::pair{o.tolerance, "tolerance"}})
    if (!(value > 0.0)) refuse(std::string(name) + " must be > 0, got " + std::to_string(value));
}

// Step (translation, rotation vector times gyration) of the body about its moved centre.
RigidMotion moved(const RigidMotion& pose, const PolishBody& body, const Vector6& step) {
  const Eigen::Vector3d turn = step.tail<3>() / body.gyration;
  const double angle = turn.norm();
  const double scale = angle > 1e-12 ? std::sin(0.5 * angle) / angle : 0.5;
  const Eigen::Quaterniond q(std::cos(0.5 * angle), scale * turn[0], scale * turn[1],
                             scale * turn[2]);
  const Eigen::Vector3d centre = pose * body.centre + step.head<3>();
  RigidMotion result{canonical(q * pose.rotation), {}};
  result.translation = centre - result.rotation * body.centre;
  return result;
}

Vector6 slope_of(const PlacedScore& score, const PolishBody& body) {
  Vector6 slope;
  slope << score.force, score.torque / body.gyration;
  return slope;
}

PolishedPose polish(const PoseObjective& objective, const PolishBody& body,
                    const RigidMotion& start, const PolishOptions& options) {
  constexpr double kSufficient = 1e-4;  // of the rise that the slope promises (Armijo)
  PlacedScore score = objective(start);
  PolishedPose result{start, score.value, score.value, 1};
  Vector6 slope = slope_of(score, body);
  Matrix6 inverse = Matrix6::Identity();  // of minus the curvature
  bool scaled = false;
  while (result.evaluations < options.evaluations) {
    Vector6 step = inverse * slope;
    if (!scaled) step *= options.first_step / std::max(step.norm(), 1e-300);
    if (!(step.dot(slope) > 0.0) || step.norm() < options.tolerance) break;
    if (step.norm() > options.longest_step) step *= options.longest_step / step.norm();
    const double promise = step.dot(slope);
    bool rose = false;
    double share = 1.0;
    while (result.evaluations < options.evaluations &&
           share * step.norm() >= 0.5 * options.tolerance) {
      const RigidMotion trial = moved(result.moving_in_fixed, body, share * step);
      score = objective(trial);
      ++result.evaluations;
      if (score.value >= result.score + kSufficient * share * promise) {
        result.moving_in_fixed = trial;
        rose = true;
        break;
      }
      // Top of the parabola through both values and the slope, kept away from both ends.
      const double loss = result.score + share * promise - score.value;
      share *= std::clamp(0.5 * share * promise / loss, 0.1, 0.5);
    }
    if (!rose) break;
    result.score = score.value;
    const Vector6 next = slope_of(score, body), s = share * step, y = slope - next;
    slope = next;
    const double sy = s.dot(y);
    if (!(sy > 1e-9 * s.norm() * y.norm())) {  // curved upwards: nothing to learn but to go on
      if (!scaled) continue;
      inverse *= 1.5;
      continue;
    }
    if (!scaled) inverse = sy / y.squaredNorm() * Matrix6::Identity();
    scaled = true;
    const Matrix6 left = Matrix6::Identity() - s * y.transpose() / sy;
    inverse = (left * inverse * left.transpose() + s * s.transpose() / sy).eval();
  }
  return result;
}

}  // namespace

std::vector<PolishedPose> polish_poses(const PoseObjective& objective, const PolishBody& body,
                                       const std::vector<RigidMotion>& poses,
                                       const PolishOptions& options) {
  check(body, options);
  std::vector<PolishedPose> result(poses.size());
  const std::vector<std::size_t> order = detail::by_place(poses, body.centre);
  constexpr std::size_t kPiece = 16;
  parallel_for((poses.size() + kPiece - 1) / kPiece, options.threads, [&](std::size_t piece, int) {
    const std::size_t end = std::min(poses.size(), (piece + 1) * kPiece);
    for (std::size_t i = piece * kPiece; i < end; ++i)
      result[order[i]] = polish(objective, body, poses[order[i]], options);
  });
  return result;
}

}  // namespace mortise
