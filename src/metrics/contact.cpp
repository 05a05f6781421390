// SPDX-License-Identifier: GPL-3.0-or-later
// Contact area, depth and the way out, by surface samples; penetration volume by an octree.
#include "mortise/metrics/contact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/solve_symmetric.hpp"
#include "core/sphere_points.hpp"
#include "mortise/core/errors.hpp"
#include "mortise/parts/diameter.hpp"
#include "mortise/parts/sample_surface.hpp"
#include "parts/distances.hpp"

namespace mortise {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

// Distances of points with their gradients by central differences over `step`.
struct Field {
  Eigen::VectorXd distance;
  Eigen::Matrix3Xd gradient;
};

Field field_at(const Solid& solid, const Eigen::Matrix3Xd& points, double step, int threads) {
  const Eigen::Index n = points.cols();
  Eigen::Matrix3Xd all(3, 7 * n);
  for (Eigen::Index i = 0; i < n; ++i) {
    all.col(7 * i) = points.col(i);
    for (int d = 0; d < 3; ++d) {
      all.col(7 * i + 1 + 2 * d) = points.col(i) + step * Eigen::Vector3d::Unit(d);
      all.col(7 * i + 2 + 2 * d) = points.col(i) - step * Eigen::Vector3d::Unit(d);
    }
  }
  const Eigen::VectorXd d = distances(solid, all, kFar, threads);
  Field field{Eigen::VectorXd(n), Eigen::Matrix3Xd(3, n)};
  for (Eigen::Index i = 0; i < n; ++i) {
    field.distance[i] = d[7 * i];
    Eigen::Vector3d g(d[7 * i + 1] - d[7 * i + 2], d[7 * i + 3] - d[7 * i + 4],
                      d[7 * i + 5] - d[7 * i + 6]);
    const double size = g.norm();
    field.gradient.col(i) = size > 0.0 ? Eigen::Vector3d(g / size) : Eigen::Vector3d::Zero();
  }
  return field;
}

// Share of a cube on the inner side of a plane at signed distance d of its centre.
double share_inside(double d, const Eigen::Vector3d& normal, double side) {
  const double width = side * std::max(normal.lpNorm<1>(), 1e-9);
  return std::clamp(0.5 - d / width, 0.0, 1.0);
}

// Share of a cube inside both of two planes: exact where they are parallel, opposed or at right
// angles to each other and to the cube, in between by Frechet's family.
double share_of_both(double a, double b, double cosine) {
  const double apart = a * b;
  const double extreme = cosine > 0.0 ? std::min(a, b) : std::max(0.0, a + b - 1.0);
  return apart + std::abs(cosine) * (extreme - apart);
}

struct Touching {
  Eigen::Matrix3Xd normals;  // of the fixed surface, outward
  Eigen::VectorXd areas;
};

// The direction u that minimises sum a max(0, -u.m)^2: the best of many, then Newton's steps on the
// sphere.
void find_pull(const Touching& touching, ContactReport& report) {
  const double total = touching.areas.sum();
  if (!(total > 0.0)) return;
  const auto cost = [&](const Eigen::Vector3d& u) {
    const Eigen::ArrayXd against = (-(touching.normals.transpose() * u)).array().max(0.0);
    return (touching.areas.array() * against.square()).sum() / total;
  };
  constexpr int kDirections = 600;
  Eigen::Vector3d best = Eigen::Vector3d::UnitZ();
  double least = kFar;
  const Eigen::Vector3d mean = touching.normals * touching.areas / total;
  const Eigen::Matrix3Xd everywhere = detail::fibonacci_sphere(kDirections);
  for (const Eigen::Vector3d u : everywhere.colwise()) {
    // Of many free directions the one most along the surfaces' mean normal.
    const double value = cost(u) - 1e-3 * u.dot(mean);
    if (value < least) {
      least = value;
      best = u;
    }
  }
  for (int step = 0; step < 20; ++step) {
    Eigen::Matrix3d curvature = 1e-9 * Eigen::Matrix3d::Identity();
    Eigen::Vector3d slope = Eigen::Vector3d::Zero();
    for (Eigen::Index k = 0; k < touching.areas.size(); ++k) {
      const Eigen::Vector3d m = touching.normals.col(k);
      const double along = best.dot(m);
      if (along >= 0.0) continue;
      slope += touching.areas[k] / total * along * m;
      curvature += touching.areas[k] / total * m * m.transpose();
    }
    const Eigen::Vector3d next = (best - detail::solve_symmetric(curvature, slope)).normalized();
    if (!next.allFinite() || !(cost(next) < cost(best))) break;
    best = next;
  }
  report.pull_direction = best;
  const Eigen::ArrayXd against = (-(touching.normals.transpose() * best)).array();
  // A tenth of a right angle forgives facets and sampling.
  report.pull_blocked = (touching.areas.array() * (against > 0.156).cast<double>()).sum() / total;
}

}  // namespace

double penetration_volume(const Solid& fixed, const Solid& moving,
                          const RigidMotion& moving_in_fixed, double cell, int threads) {
  if (!(cell > 0.0) || !std::isfinite(cell))
    throw InputError("penetration volume: cell must be > 0 and finite, got " +
                     std::to_string(cell));
  const Eigen::AlignedBox3d own = moving.bounds();
  Eigen::AlignedBox3d moved;
  for (int corner = 0; corner < 8; ++corner)
    moved.extend(moving_in_fixed *
                 Eigen::Vector3d(own.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner))));
  const Eigen::AlignedBox3d box = fixed.bounds().intersection(moved);
  if (box.isEmpty()) return 0.0;
  double side = box.sizes().maxCoeff();
  int levels = 0;
  while (side > cell && levels < 20) {
    side *= 0.5;
    ++levels;
  }
  // From cells about eight to an edge: below that the first levels are not worth their calls.
  const int first = std::min(levels, 3);
  side = std::ldexp(side, levels - first);
  std::vector<Eigen::Vector3d> centres;
  const Eigen::Vector3i count = (box.sizes() / side).array().ceil().max(1.0).matrix().cast<int>();
  for (int i = 0; i < count[0]; ++i)
    for (int j = 0; j < count[1]; ++j)
      for (int k = 0; k < count[2]; ++k)
        centres.emplace_back(box.min() + side * Eigen::Vector3d(i + 0.5, j + 0.5, k + 0.5));
  const RigidMotion back = inverse(moving_in_fixed);
  double volume = 0.0;
  for (int level = first;; ++level, side *= 0.5) {
    Eigen::Matrix3Xd points(3, static_cast<Eigen::Index>(centres.size()));
    for (std::size_t i = 0; i < centres.size(); ++i)
      points.col(static_cast<Eigen::Index>(i)) = centres[i];
    const double half_diagonal = 0.5 * std::sqrt(3.0) * side;
    const Eigen::VectorXd a = distances(fixed, points, half_diagonal, threads);
    const Eigen::VectorXd b = distances(moving, back * points, half_diagonal, threads);
    std::vector<Eigen::Vector3d> mixed;
    for (Eigen::Index i = 0; i < points.cols(); ++i) {
      if (a[i] >= half_diagonal || b[i] >= half_diagonal) continue;
      if (a[i] <= -half_diagonal && b[i] <= -half_diagonal)
        volume += side * side * side;
      else
        mixed.emplace_back(points.col(i));
    }
    if (mixed.empty()) return volume;
    if (level >= levels) {
      Eigen::Matrix3Xd leaves(3, static_cast<Eigen::Index>(mixed.size()));
      for (std::size_t i = 0; i < mixed.size(); ++i)
        leaves.col(static_cast<Eigen::Index>(i)) = mixed[i];
      const Field in_fixed = field_at(fixed, leaves, 0.25 * side, threads);
      Field in_moving = field_at(moving, back * leaves, 0.25 * side, threads);
      in_moving.gradient = moving_in_fixed.rotation.toRotationMatrix() * in_moving.gradient;
      for (Eigen::Index i = 0; i < leaves.cols(); ++i) {
        const Eigen::Vector3d m = in_fixed.gradient.col(i);
        const Eigen::Vector3d n = in_moving.gradient.col(i);
        volume += side * side * side *
                  share_of_both(share_inside(in_fixed.distance[i], m, side),
                                share_inside(in_moving.distance[i], n, side), m.dot(n));
      }
      return volume;
    }
    centres.clear();
    for (const Eigen::Vector3d& c : mixed)
      for (int octant = 0; octant < 8; ++octant)
        centres.emplace_back(
            c + 0.25 * side *
                    Eigen::Vector3d(octant & 1 ? 1 : -1, octant & 2 ? 1 : -1, octant & 4 ? 1 : -1));
  }
}

ContactReport measure_contact(const TriangleMesh& fixed_mesh, const Solid& fixed,
                              const TriangleMesh& moving_mesh, const Solid& moving,
                              const RigidMotion& moving_in_fixed, const ContactOptions& options) {
  if (!(options.tolerance > 0.0) || !(options.resolution > 0.0) || options.samples < 100)
    throw InputError("contact: tolerance and resolution must be > 0 and samples >= 100, got " +
                     std::to_string(options.tolerance) + ", " + std::to_string(options.resolution) +
                     " and " + std::to_string(options.samples));
  const double unit = std::min(diameter_of(fixed_mesh.vertices), diameter_of(moving_mesh.vertices));
  const double tolerance = options.tolerance * unit;
  const double fixed_area = surface_area(fixed_mesh);
  const double moving_area = surface_area(moving_mesh);
  const double density = options.samples / std::min(fixed_area, moving_area);
  ContactReport report;
  std::vector<Eigen::Vector3d> normals;
  std::vector<double> areas;
  for (const bool of_moving : {true, false}) {
    const double area = of_moving ? moving_area : fixed_area;
    const auto count = static_cast<Eigen::Index>(std::min(200.0 * options.samples, density * area));
    const SurfaceSamples samples = sample_surface(of_moving ? moving_mesh : fixed_mesh, count);
    const double each = area / static_cast<double>(count);
    const Solid& other = of_moving ? fixed : moving;
    const RigidMotion there = of_moving ? moving_in_fixed : inverse(moving_in_fixed);
    const Eigen::Matrix3Xd points = there * samples.points;
    const Eigen::VectorXd d = distances(other, points, kFar, options.threads);
    report.penetration_depth = std::max(report.penetration_depth, -d.minCoeff());
    std::vector<Eigen::Index> near;
    for (Eigen::Index i = 0; i < count; ++i)
      if (std::abs(d[i]) <= tolerance) near.push_back(i);
    Eigen::Matrix3Xd near_points(3, static_cast<Eigen::Index>(near.size()));
    for (std::size_t k = 0; k < near.size(); ++k)
      near_points.col(static_cast<Eigen::Index>(k)) = points.col(near[k]);
    const Field field = field_at(other, near_points, 0.1 * tolerance, options.threads);
    const Eigen::Matrix3d turn = there.rotation.toRotationMatrix();
    for (std::size_t k = 0; k < near.size(); ++k) {
      const Eigen::Vector3d normal = turn * samples.normals.col(near[k]);
      const Eigen::Vector3d gradient = field.gradient.col(static_cast<Eigen::Index>(k));
      if (normal.dot(gradient) > -0.5) continue;
      report.contact_area += 0.5 * each;
      normals.emplace_back(of_moving ? gradient : Eigen::Vector3d(samples.normals.col(near[k])));
      areas.push_back(each);
    }
  }
  report.penetration_volume = penetration_volume(fixed, moving, moving_in_fixed,
                                                 options.resolution * unit, options.threads);
  Touching touching{
      Eigen::Matrix3Xd(3, static_cast<Eigen::Index>(normals.size())),
      Eigen::Map<const Eigen::VectorXd>(areas.data(), static_cast<Eigen::Index>(areas.size()))};
  for (std::size_t k = 0; k < normals.size(); ++k)
    touching.normals.col(static_cast<Eigen::Index>(k)) = normals[k];
  find_pull(touching, report);
  return report;
}

}  // namespace mortise
