// SPDX-License-Identifier: GPL-3.0-or-later
// Greedy clustering of ranked poses by interface RMSD.
//
// For a founder a, with F and M the interface points of the two bodies (n_F + n_M = n), the
// superposed RMSD r of a pose b follows from moments in constant time (core/paired_moments.hpp).
// Most founders need not even that. Let T be the best superposition, u = rms |T x - x| over F and
// v = rms |T b p - a p| over M, so that n_F u^2 + n_M v^2 = n r^2. With c the mean of F, J = mean
// (|x~|^2 I - x~ x~^T) its inertia and (w, q) the quaternion of T's rotation, u^2 = |T c - c|^2 +
// 4 q^T J q (mortise/core/pose_distance.hpp), and a point y moves by at most |T c - c| + 2 |q| |y -
// c|. By Cauchy, |T y - y| <= g u with g^2 = 1 + |y - c|^2 / J_min. For y = a m, m the mean of M:
//   |b m - a m| = |T b m - T a m| <= |T b m - a m| + |a m - T a m| <= v + g u
//              <= r sqrt(n / n_M + g^2 n / n_F),
// again by Cauchy. A pose farther off than that, with the clusters' radius for r, cannot join.
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "core/paired_moments.hpp"
#include "core/point_grid.hpp"
#include "mortise/core/errors.hpp"
#include "mortise/core/pose_distance.hpp"
#include "poses/cluster_sizes.hpp"

namespace mortise {
namespace {

struct Founder {
  detail::PairedMoments fixed;   // interface of the fixed body, paired with itself
  detail::PairedMoments moving;  // of the moving body: input frame, paired with the founder's pose
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();   // of the moving body's interface, input frame
  Eigen::Vector3d place = Eigen::Vector3d::Zero();  // the same in the founder's pose
  double reach_sq = -1.0;  // how far a member's mean may lie from `place`; < 0: no member
};

Eigen::Matrix3Xd chosen(const Eigen::Matrix3Xd& points, const std::vector<Eigen::Index>& columns) {
  Eigen::Matrix3Xd out(3, static_cast<Eigen::Index>(columns.size()));
  for (Eigen::Index i = 0; i < out.cols(); ++i) out.col(i) = points.col(columns[i]);
  return out;
}

class InterfaceFinder {
 public:
  InterfaceFinder(const Eigen::Matrix3Xd& fixed, const Eigen::Matrix3Xd& moving, double cutoff,
                  double radius)
      : fixed_(fixed), moving_(moving), grid_(fixed, cutoff, cutoff), radius_(radius) {}

  [[nodiscard]] Founder founder(const RigidMotion& pose) const {
    const Eigen::Matrix3Xd placed = pose * moving_;
    std::vector<char> touched(static_cast<std::size_t>(fixed_.cols()), 0);
    std::vector<Eigen::Index> of_fixed, of_moving;
    for (Eigen::Index i = 0; i < placed.cols(); ++i) {
      bool near = false;
      grid_.for_each_near(placed.col(i), [&](std::int32_t k) {
        near = true;
        touched[k] = 1;
      });
      if (near) of_moving.push_back(i);
    }
    Founder out;
    if (of_moving.empty()) return out;
    for (Eigen::Index k = 0; k < fixed_.cols(); ++k)
      if (touched[k] != 0) of_fixed.push_back(k);
    const Eigen::Matrix3Xd x = chosen(fixed_, of_fixed);
    out.fixed = detail::paired_moments(x, x);
    out.moving = detail::paired_moments(chosen(moving_, of_moving), chosen(placed, of_moving));
    out.mean = out.moving.model_mean;
    out.place = out.moving.reference_mean;
    const double n_f = out.fixed.count, n_m = out.moving.count, n = n_f + n_m;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(PoseDistance(x).inertia(),
                                                                Eigen::EigenvaluesOnly);
    const double smallest = solver.eigenvalues()(0);
    // A line of points holds no rotation: the bound is infinite.
    const double g_sq = smallest > 0.0
                            ? 1.0 + (out.place - out.fixed.model_mean).squaredNorm() / smallest
                            : std::numeric_limits<double>::infinity();
    out.reach_sq = radius_ * radius_ * (n / n_m + g_sq * n / n_f) * (1.0 + 1e-9) + 1e-9;
    return out;
  }

 private:
  const Eigen::Matrix3Xd& fixed_;
  const Eigen::Matrix3Xd& moving_;
  detail::PointGrid grid_;
  double radius_;
};

bool joins(const Founder& founder, const Eigen::Matrix3d& R, const Eigen::Vector3d& t,
           double radius) {
  if (!((R * founder.mean + t - founder.place).squaredNorm() <= founder.reach_sq)) return false;
  return detail::rmsd_superposed(
             detail::merge(founder.fixed, detail::moved(founder.moving, R, t))) < radius;
}

void check(const Eigen::Matrix3Xd& points, const char* which) {
  if (points.cols() == 0 || !points.allFinite())
    throw InputError(std::string("cluster: expected finite points of the ") + which +
                     " body, found " + (points.cols() == 0 ? "none" : "one that is not finite"));
}

}  // namespace

Clusters cluster_poses_by_interface(const std::vector<RigidMotion>& poses,
                                    const Eigen::Matrix3Xd& fixed, const Eigen::Matrix3Xd& moving,
                                    const InterfaceClusterOptions& options) {
  detail::check_cluster_options(options.radius, options.min_size);
  if (!(options.interface_cutoff > 0.0 && std::isfinite(options.interface_cutoff)))
    throw InputError("cluster: interface_cutoff must be > 0 and finite, got " +
                     std::to_string(options.interface_cutoff));
  check(fixed, "fixed");
  check(moving, "moving");
  const InterfaceFinder finder(fixed, moving, options.interface_cutoff, options.radius);
  std::vector<Founder> founders;
  Clusters result{std::vector<int>(poses.size(), -1), {}, {}};
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Eigen::Matrix3d R = poses[i].rotation.toRotationMatrix();
    const Eigen::Vector3d& t = poses[i].translation;
    if (!R.allFinite() || !t.allFinite())
      throw InputError("cluster: pose " + std::to_string(i) + " is not finite");
    const auto found = std::find_if(founders.begin(), founders.end(), [&](const Founder& f) {
      return joins(f, R, t, options.radius);
    });
    const auto cluster = static_cast<int>(found - founders.begin());
    if (found == founders.end()) {
      if (options.max_clusters > 0 && founders.size() >= options.max_clusters) continue;
      founders.push_back(finder.founder(poses[i]));
      result.founders.push_back(i);
    }
    result.cluster_of[i] = cluster;
  }
  return detail::counted(std::move(result), options.min_size);
}

}  // namespace mortise
