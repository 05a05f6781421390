// SPDX-License-Identifier: GPL-3.0-or-later
// Hausdorff distances between unions of balls and solids.
#include "mortise/parts/hausdorff.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "mortise/core/errors.hpp"
#include "mortise/core/threads.hpp"
#include "mortise/parts/sphere_tree.hpp"
#include "parts/node_field.hpp"

namespace mortise {
namespace {

constexpr double kExact = std::numeric_limits<double>::infinity();

Eigen::Matrix3Xd columns(const std::vector<Eigen::Vector3d>& points) {
  Eigen::Matrix3Xd result(3, static_cast<Eigen::Index>(points.size()));
  for (Eigen::Index i = 0; i < result.cols(); ++i) result.col(i) = points[i];
  return result;
}

// Points of the spheres that lie in no other ball. Of n points along a spiral on the unit sphere
// none of the sphere is further than 2.8 / sqrt(n) from one (measured, n = 12 to 1e5).
Eigen::Matrix3Xd union_boundary(const Eigen::Matrix4Xd& balls, const SphereTree& tree,
                                double spacing, int threads) {
  std::vector<std::vector<Eigen::Vector3d>> found(static_cast<std::size_t>(balls.cols()));
  parallel_for(found.size(), threads, [&](std::size_t b, int) {
    const Eigen::Vector4d ball = balls.col(static_cast<Eigen::Index>(b));
    const double radius = ball[3];
    const auto count = std::max<Eigen::Index>(
        12, static_cast<Eigen::Index>(std::ceil(std::pow(2.8 * radius / spacing, 2))));
    Eigen::Matrix3Xd points(3, count);
    const double turn = std::numbers::pi * (3.0 - std::sqrt(5.0));
    for (Eigen::Index i = 0; i < count; ++i) {
      const double z = 1.0 - (2.0 * static_cast<double>(i) + 1.0) / static_cast<double>(count);
      const double s = std::sqrt(1.0 - z * z), angle = turn * static_cast<double>(i);
      points.col(i) << s * std::cos(angle), s * std::sin(angle), z;
    }
    points = (radius * points).colwise() + Eigen::Vector3d(ball.head<3>());
    const Eigen::VectorXd beyond = distance_to_union(tree, points, 1);
    for (Eigen::Index i = 0; i < count; ++i)
      if (beyond[i] >= -1e-9 * radius) found[b].emplace_back(points.col(i));
  });
  std::vector<Eigen::Vector3d> all;
  for (const auto& points : found) all.insert(all.end(), points.begin(), points.end());
  return columns(all);
}

// Distances from a body at many points, in pieces so that all threads work.
Eigen::VectorXd distances(const Solid& solid, const Eigen::Matrix3Xd& points, int threads) {
  Eigen::VectorXd result(points.cols());
  constexpr Eigen::Index kChunk = 4096;
  const Eigen::Index chunks = (points.cols() + kChunk - 1) / kChunk;
  parallel_for(static_cast<std::size_t>(chunks), threads, [&](std::size_t chunk, int) {
    const Eigen::Index first = static_cast<Eigen::Index>(chunk) * kChunk;
    const Eigen::Index count = std::min(kChunk, points.cols() - first);
    result.segment(first, count) = solid.signed_distance(points.middleCols(first, count), kExact);
  });
  return result;
}

Eigen::Matrix3Xd nodes_inside(const Solid& solid, double spacing, int threads) {
  const Eigen::AlignedBox3d box = solid.bounds();
  const double cells = std::ceil(box.sizes().maxCoeff() / spacing);
  const GridNodes nodes = parts::cell_centers(box, static_cast<int>(std::clamp(cells, 2.0, 512.0)));
  // Only the sign counts.
  const DistanceGrid grid =
      distance_grid(solid, nodes, {.band = nodes.spacing, .threads = threads});
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < nodes.size.x(); ++i)
    for (int j = 0; j < nodes.size.y(); ++j)
      for (int k = 0; k < nodes.size.z(); ++k)
        if (grid.values[nodes.index(i, j, k)] < 0.0F) points.push_back(nodes.node(i, j, k));
  return columns(points);
}

double largest(const Eigen::VectorXd& values) {
  return values.size() == 0 ? 0.0 : std::max(0.0, values.maxCoeff());
}

}  // namespace

double HausdorffDistance::of_solids() const noexcept {
  return std::max(balls_beyond_solid, solid_beyond_balls);
}

double HausdorffDistance::of_surfaces() const noexcept {
  return std::max(balls_to_surface, surface_to_balls);
}

HausdorffDistance hausdorff_distance(const Eigen::Matrix4Xd& balls, const Solid& solid,
                                     const Eigen::Matrix3Xd& surface,
                                     const HausdorffOptions& options) {
  if (surface.cols() == 0 || !surface.allFinite())
    throw InputError("hausdorff_distance: finite points of the surface expected, got " +
                     std::to_string(surface.cols()) + " points");
  if (!(options.spacing >= 0.0) || !std::isfinite(options.spacing))
    throw InputError("hausdorff_distance: spacing must be >= 0, got " +
                     std::to_string(options.spacing));
  HausdorffDistance result;
  result.spacing =
      options.spacing > 0.0 ? options.spacing : solid.bounds().sizes().maxCoeff() / 200.0;
  const SphereTree tree = sphere_tree(balls);  // checks the balls
  const Eigen::Matrix3Xd boundary = union_boundary(balls, tree, result.spacing, options.threads);
  const Eigen::VectorXd from_balls = distances(solid, boundary, options.threads);
  result.balls_beyond_solid = largest(from_balls);
  result.balls_to_surface = largest(from_balls.cwiseAbs());

  const Eigen::VectorXd from_surface = distance_to_union(tree, surface, options.threads);
  const Eigen::Matrix3Xd inside = nodes_inside(solid, 2.0 * result.spacing, options.threads);
  result.solid_beyond_balls =
      std::max(largest(from_surface), largest(distance_to_union(tree, inside, options.threads)));
  result.samples = boundary.cols() + surface.cols() + inside.cols();

  // Outside the union that is the way to its boundary too; inside, the nearest sample of it is.
  std::vector<Eigen::Vector3d> buried;
  for (Eigen::Index i = 0; i < surface.cols(); ++i)
    if (from_surface[i] < 0.0) buried.emplace_back(surface.col(i));
  result.surface_to_balls = largest(from_surface);
  if (!buried.empty()) {
    Eigen::Matrix4Xd points = Eigen::Matrix4Xd::Zero(4, boundary.cols());
    points.topRows<3>() = boundary;
    result.surface_to_balls = std::max(
        result.surface_to_balls, largest(distance_to_union(sphere_tree(points, {.arity = 8}),
                                                           columns(buried), options.threads)));
  }
  return result;
}

}  // namespace mortise
