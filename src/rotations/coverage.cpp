// SPDX-License-Identifier: GPL-3.0-or-later
// Covering radius and mean distance of rotation sets from their Voronoi cells.
#include "mortise/rotations/coverage.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "mortise/core/rigid_motion.hpp"
#include "mortise/core/threads.hpp"
#include "mortise/rotations/rotation_index.hpp"
#include "rotations/voronoi_cell.hpp"

namespace mortise {
namespace {

constexpr double kPi = std::numbers::pi;

// Volume of a region of the unit 3-sphere and the integral of the rotation angle to q over it.
struct Moments {
  double volume = 0.0;
  double angle = 0.0;
};

// Both, per solid angle, of the ray from q to the quaternion angle rho = atan2(rise, run): the
// integrals of sin^2 t and 2 t sin^2 t over 0..rho.
Moments ray_moments(double rise, double run) {
  const double rho = std::atan2(rise, run);
  const double norm_sq = rise * rise + run * run;
  const double sin_2rho = 2.0 * rise * run / norm_sq;
  return {0.5 * rho - 0.25 * sin_2rho, 0.5 * (rho * rho - rho * sin_2rho + rise * rise / norm_sq)};
}

// Adds the cone from q over the part of `face` seen between three unit directions.
void add_cone(const VoronoiCell::Face& face, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
              const Eigen::Vector3d& c, int depth, Moments& sum) {
  constexpr double kWidest = 0.6;  // chord; wider triangles are split
  const double widest_sq =
      std::max({(a - b).squaredNorm(), (b - c).squaredNorm(), (c - a).squaredNorm()});
  if (widest_sq > kWidest * kWidest && depth > 0) {
    const Eigen::Vector3d ab = (a + b).normalized();
    const Eigen::Vector3d bc = (b + c).normalized();
    const Eigen::Vector3d ca = (c + a).normalized();
    add_cone(face, a, ab, ca, depth - 1, sum);
    add_cone(face, ab, b, bc, depth - 1, sum);
    add_cone(face, ca, bc, c, depth - 1, sum);
    add_cone(face, ab, bc, ca, depth - 1, sum);
    return;
  }
  // Radon's seven points of degree five on the flat triangle; it is seen under d_omega = det / 2 /
  // |p|^3 d_area.
  struct Node {
    double l0, l1, l2, weight;
  };
  static const double r15 = std::sqrt(15.0);
  static const double p1 = (6.0 - r15) / 21.0, p2 = (6.0 + r15) / 21.0;
  static const double w1 = (155.0 - r15) / 1200.0, w2 = (155.0 + r15) / 1200.0;
  static const Node kNodes[7] = {{1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0, 9.0 / 40.0},
                                 {p1, p1, 1.0 - 2.0 * p1, w1},
                                 {p1, 1.0 - 2.0 * p1, p1, w1},
                                 {1.0 - 2.0 * p1, p1, p1, w1},
                                 {p2, p2, 1.0 - 2.0 * p2, w2},
                                 {p2, 1.0 - 2.0 * p2, p2, w2},
                                 {1.0 - 2.0 * p2, p2, p2, w2}};
  const double half_det = 0.5 * std::abs(a.dot(b.cross(c)));
  for (const Node& node : kNodes) {
    const Eigen::Vector3d p = node.l0 * a + node.l1 * b + node.l2 * c;
    const double length = p.norm();
    const Moments ray = ray_moments(face.height * length, face.normal.dot(p));
    const double weight = node.weight * half_det / (length * length * length);
    sum.volume += weight * ray.volume;
    sum.angle += weight * ray.angle;
  }
}

Moments cell_moments(const VoronoiCell& cell) {
  Moments sum;
  for (const VoronoiCell::Face& face : cell.faces()) {
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const auto& y : face.ring) middle += y;
    middle.normalize();
    for (std::size_t i = 0; i < face.ring.size(); ++i)
      add_cone(face, middle, face.ring[i].normalized(),
               face.ring[(i + 1) % face.ring.size()].normalized(), 6, sum);
  }
  return sum;
}

// Calls visit(member, cell) for the cell of every member, on several threads.
template <typename Visit>
void for_each_cell(const Eigen::Matrix4Xd& quaternions, int threads, const Visit& visit) {
  constexpr Eigen::Index kBlock = 64;
  const RotationIndex index(quaternions);
  std::vector<VoronoiCell> cells(resolve_threads(threads));
  const Eigen::Index count = quaternions.cols();
  parallel_for((count + kBlock - 1) / kBlock, threads, [&](std::size_t block, int worker) {
    const Eigen::Index begin = static_cast<Eigen::Index>(block) * kBlock;
    for (Eigen::Index i = begin; i < std::min(begin + kBlock, count); ++i) {
      cut_cell(quaternions, index, i, cells[worker]);
      visit(i, cells[worker]);
    }
  });
}

}  // namespace

double covering_radius(const Eigen::Matrix4Xd& quaternions, int threads) {
  Eigen::VectorXd radius(quaternions.cols());
  for_each_cell(quaternions, threads, [&](Eigen::Index i, const VoronoiCell& cell) {
    radius(i) = cell.covering_angle();
  });
  return radius.maxCoeff();
}

Coverage measure_coverage(const Eigen::Matrix4Xd& quaternions, int threads) {
  const Eigen::Index count = quaternions.cols();
  Eigen::VectorXd radius(count), nearest(count), volume(count), angle(count);
  for_each_cell(quaternions, threads, [&](Eigen::Index i, const VoronoiCell& cell) {
    radius(i) = cell.covering_angle();
    double height = VoronoiCell::kFarthest;
    for (const VoronoiCell::Face& face : cell.faces()) height = std::min(height, face.height);
    nearest(i) = std::min(kPi, 4.0 * std::atan(height));
    const Moments moments = cell_moments(cell);
    volume(i) = moments.volume;
    angle(i) = moments.angle;
  });
  // Sums run in the order of the columns: the same bytes for any number of threads. SO(3) is half
  // the 3-sphere.
  const double total = volume.sum();
  const double mean_volume = total / static_cast<double>(count);
  Eigen::Index worst = 0;
  const double covering = radius.maxCoeff(&worst);
  VoronoiCell cell;
  cut_cell(quaternions, RotationIndex(quaternions), worst, cell);
  const Eigen::Vector3d y = cell.farthest_corner();
  const Eigen::Quaterniond farthest =
      canonical(Eigen::Quaterniond(quaternions(0, worst), quaternions(1, worst),
                                   quaternions(2, worst), quaternions(3, worst)) *
                Eigen::Quaterniond(1.0, y.x(), y.y(), y.z()));
  return {covering,
          {farthest.w(), farthest.x(), farthest.y(), farthest.z()},
          angle.sum() / total,
          nearest.minCoeff(),
          volume.minCoeff() / mean_volume,
          volume.maxCoeff() / mean_volume,
          std::abs(total / (kPi * kPi) - 1.0)};
}

}  // namespace mortise
