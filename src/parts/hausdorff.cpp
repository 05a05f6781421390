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
#include "parts/distances.hpp"
#include "parts/grid_blocks.hpp"
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

// What the nodes of a grid over the solid's box say: inside the solid how far the balls are, inside
// the balls how far the solid is. Elsewhere within the balls the solid can only be nearer: a point
// furthest from it lies on the balls' boundary or in the solid's convex hull.
struct Depths {
  double solid_beyond_balls = 0.0, balls_beyond_solid = 0.0;
  Eigen::Index samples = 0;
};

Depths depths_at_nodes(const Solid& solid, const SphereTree& tree, const GridNodes& nodes,
                       double balls_beyond_solid, int threads) {
  const GridBlocks blocks(nodes);
  std::vector<Depths> found(blocks.count());
  // Outside the solid only what lies further out than the boundary's samples do is asked for.
  const double band = std::max(1e-3 * nodes.spacing, balls_beyond_solid);
  parallel_for(blocks.count(), threads, [&](std::size_t index, int) {
    const Eigen::Matrix3Xd points = blocks.block(index).points;
    const Eigen::VectorXd side = solid.signed_distance(points, band);
    std::vector<Eigen::Vector3d> asked;
    std::vector<bool> inside;
    for (Eigen::Index i = 0; i < points.cols(); ++i)
      if (side[i] < 0.0 || side[i] >= band) {
        asked.emplace_back(points.col(i));
        inside.push_back(side[i] < 0.0);
      }
    if (asked.empty()) return;
    const Eigen::VectorXd beyond = distance_to_union(tree, columns(asked), 1);
    std::vector<Eigen::Vector3d> filled;
    for (std::size_t i = 0; i < asked.size(); ++i) {
      const double d = beyond[static_cast<Eigen::Index>(i)];
      if (inside[i]) {
        found[index].solid_beyond_balls = std::max(found[index].solid_beyond_balls, d);
        ++found[index].samples;
      } else if (d < 0.0) {
        filled.push_back(asked[i]);
      }
    }
    found[index].samples += static_cast<Eigen::Index>(filled.size());
    if (!filled.empty())
      found[index].balls_beyond_solid = solid.signed_distance(columns(filled), kExact).maxCoeff();
  });
  Depths all;
  for (const Depths& one : found) {
    all.solid_beyond_balls = std::max(all.solid_beyond_balls, one.solid_beyond_balls);
    all.balls_beyond_solid = std::max(all.balls_beyond_solid, one.balls_beyond_solid);
    all.samples += one.samples;
  }
  return all;
}

// Cell centres over the solid's box about `spacing` apart.
GridNodes nodes_of(const Solid& solid, double spacing) {
  const Eigen::AlignedBox3d box = solid.bounds();
  const double cells = std::ceil(box.sizes().maxCoeff() / spacing);
  return parts::cell_centers(box, static_cast<int>(std::clamp(cells, 2.0, 512.0)));
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
  const Eigen::VectorXd from_balls = distances(solid, boundary, kExact, options.threads);
  result.balls_beyond_solid = largest(from_balls);
  result.balls_to_surface = largest(from_balls.cwiseAbs());

  const Eigen::VectorXd from_surface = distance_to_union(tree, surface, options.threads);
  const GridNodes nodes = nodes_of(solid, 2.0 * result.spacing);
  result.node_spacing = nodes.spacing;
  const Depths depths =
      depths_at_nodes(solid, tree, nodes, result.balls_beyond_solid, options.threads);
  result.solid_beyond_balls = std::max(largest(from_surface), depths.solid_beyond_balls);
  result.balls_beyond_solid = std::max(result.balls_beyond_solid, depths.balls_beyond_solid);
  result.samples = boundary.cols() + surface.cols() + depths.samples;

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
