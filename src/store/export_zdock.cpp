// SPDX-License-Identifier: GPL-3.0-or-later
// Poses in the .out layout of ZDOCK 3.0.2.
//
// A reader rebuilds x' = R (x - l) - s t + r with R = Rz(psi) Rx(theta) Rz(phi), grid step s, whole
// numbers t (those of N/2 and more stand for t - N), and the two centres l and r of the header. So
// s t = r - R l - T for our x' = R x + T. ZDOCK's own step of 1.2 A would move a pose by up to 1 A;
// readers take s and N from the header, so ours is fine.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>

#include "mortise/core/errors.hpp"
#include "mortise/store/export.hpp"

namespace mortise {
namespace {

constexpr double kSpacing = 0.001;   // as fine as the coordinates of a PDB file
constexpr double kFarthest = 1.0e6;  // keeps N within a 32-bit integer

// Middle of the knots' box, rounded as printed so that the printed centre is the exact one.
Eigen::Vector3d printed_centre(const Knots& knots) {
  if (knots.size() == 0) return Eigen::Vector3d::Zero();
  const auto centres = knots.points.topRows<3>();
  const Eigen::Vector3d middle =
      0.5 * (centres.rowwise().minCoeff() + centres.rowwise().maxCoeff());
  return (1000.0 * middle).array().round() / 1000.0;
}

// psi, theta, phi of R = Rz(psi) Rx(theta) Rz(phi), from half angles: no loss of digits near theta
// = 0 or pi.
Eigen::Vector3d euler_angles(const Eigen::Quaterniond& q) {
  const double half_sum = std::atan2(q.z(), q.w());
  const double half_difference = std::atan2(q.y(), q.x());
  const double theta = 2.0 * std::atan2(std::hypot(q.x(), q.y()), std::hypot(q.w(), q.z()));
  return {std::remainder(half_sum + half_difference, 2.0 * std::numbers::pi), theta,
          std::remainder(half_sum - half_difference, 2.0 * std::numbers::pi)};
}

void check_name(const BodyRecord& body, const char* name) {
  if (body.path.empty() || body.path.find_first_of(" \t\r\n") != std::string::npos)
    throw InputError(std::string("format zdock cannot carry the path of the ") + name +
                     " input, \"" + body.path + "\": expected one without blanks");
}

}  // namespace

std::string export_zdock(const Run& run, const ExportOptions& options) {
  if (!of_molecules(run))
    throw InputError("format zdock is for molecules; this is a " + run.kind +
                     " run of other bodies");
  check_name(run.fixed, "fixed");
  check_name(run.moving, "moving");
  const std::vector<std::size_t> poses = chosen_poses(run, ExportFormat::kZdock, options);
  const Eigen::Vector3d r = printed_centre(run.fixed.knots);
  const Eigen::Vector3d l = printed_centre(run.moving.knots);
  using Steps = Eigen::Matrix<long, 3, 1>;
  std::vector<Steps> steps;
  long farthest = 0;
  for (const std::size_t i : poses) {
    const RigidMotion& motion = run.poses.poses[i].moving_in_fixed;
    const Eigen::Vector3d shift = r - motion * l;
    if (!(shift.cwiseAbs().maxCoeff() < kFarthest))
      throw InputError("format zdock: pose " + std::to_string(i + 1) + " is too far away");
    steps.emplace_back((shift / kSpacing).array().round().matrix().cast<long>());
    farthest = std::max(farthest, steps.back().cwiseAbs().maxCoeff());
  }
  const long n = 2 * (farthest + 1);  // so that -N/2 < t < N/2
  std::array<char, 256> line;
  std::snprintf(line.data(), line.size(),
                "%ld\t%.3f\t0\n0.000000\t0.000000\t0.000000\n0.000000\t0.000000\t0.000000\n", n,
                kSpacing);
  std::string text = line.data();
  for (const auto& [path, centre] :
       {std::pair{&run.fixed.path, &r}, std::pair{&run.moving.path, &l}}) {
    std::snprintf(line.data(), line.size(), "\t%.3f\t%.3f\t%.3f\n", centre->x(), centre->y(),
                  centre->z());
    text += *path + line.data();
  }
  for (std::size_t k = 0; k < poses.size(); ++k) {
    const Pose& pose = run.poses.poses[poses[k]];
    const Eigen::Vector3d angles = euler_angles(pose.moving_in_fixed.rotation);
    const Steps t = steps[k].unaryExpr([n](long step) { return step < 0 ? step + n : step; });
    std::snprintf(line.data(), line.size(), "%.7f\t%.7f\t%.7f\t%ld\t%ld\t%ld\t%.6f\n", angles[0],
                  angles[1], angles[2], t[0], t[1], t[2], pose.score);
    text += line.data();
  }
  return text;
}

}  // namespace mortise
