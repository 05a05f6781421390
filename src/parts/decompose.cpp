// SPDX-License-Identifier: GPL-3.0-or-later
// Spherical decomposition: grid, inner balls, expansion, reduction.
#include "mortise/parts/decompose.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include "mortise/core/errors.hpp"
#include "mortise/parts/uncontained_balls.hpp"
#include "parts/boundary_cells.hpp"
#include "parts/inner_balls.hpp"
#include "parts/node_field.hpp"
#include "parts/reduce_balls.hpp"

namespace mortise {
namespace {

using parts::GridBall;
using parts::NodeField;

void check(const DecomposeOptions& options) {
  if (options.grid < 2 || options.grid > 1024)
    throw InputError("decompose: grid must be 2 to 1024 nodes a side, got " +
                     std::to_string(options.grid));
  if (!(options.protrusion >= 0.0 && options.protrusion <= 1.0))
    throw InputError("decompose: protrusion must be in [0, 1], got " +
                     std::to_string(options.protrusion));
  if (!(options.expansion >= 0.0 && options.expansion <= 1.0))
    throw InputError("decompose: expansion must be in [0, 1], got " +
                     std::to_string(options.expansion));
}

std::vector<GridBall> inner_balls(const NodeField& field, const DecomposeOptions& options) {
  switch (options.method) {
    case DecomposeMethod::kSkeletal:
      return parts::skeletal_balls(field, options.protrusion);
    case DecomposeMethod::kInnerPacking:
      return parts::packed_balls(field);
    case DecomposeMethod::kOctree:
      return parts::octree_balls(field);
  }
  throw InputError("decompose: unknown method");
}

std::vector<std::size_t> reduced(const NodeField& field, const std::vector<GridBall>& balls,
                                 const std::vector<GridBall>& grown, double growth,
                                 const DecomposeOptions& options) {
  std::vector<std::size_t> kept(balls.size());
  std::iota(kept.begin(), kept.end(), std::size_t{0});
  if (options.reduction == Reduction::kCover)
    kept = parts::cover_nodes(field, grown, options.threads);
  if (options.reduction == Reduction::kContainment) {
    Eigen::Matrix4Xd points(4, static_cast<Eigen::Index>(balls.size()));
    for (Eigen::Index i = 0; i < points.cols(); ++i)
      points.col(i) << balls[i].center, balls[i].radius;
    const std::vector<Eigen::Index> rest = uncontained_balls(points, growth);
    kept.assign(rest.begin(), rest.end());
  }
  return kept;
}

Eigen::Vector4d in_solid_frame(const NodeField& field, const GridBall& ball) {
  Eigen::Vector4d knot;
  knot << field.origin + field.spacing * ball.center, field.spacing * ball.radius;
  return knot;
}

}  // namespace

Decomposition decompose(const Solid& solid, const DecomposeOptions& options) {
  check(options);
  const GridNodes nodes = parts::cell_centers(solid.bounds(), options.grid);
  constexpr Eigen::Index kMostNodes = Eigen::Index{1} << 28;
  if (nodes.count() > kMostNodes)
    throw InputError("decompose: a grid of " + std::to_string(options.grid) + " a side has " +
                     std::to_string(nodes.count()) + " nodes, more than 2^28 (4 GB); take one of " +
                     std::to_string(static_cast<int>(
                         options.grid * std::cbrt(static_cast<double>(kMostNodes) /
                                                  static_cast<double>(nodes.count())))) +
                     " or less");
  return decompose(distance_grid(solid, nodes, {.threads = options.threads}), options);
}

Decomposition decompose(const DistanceGrid& grid, const DecomposeOptions& options) {
  check(options);
  if (grid.values.size() != static_cast<std::size_t>(grid.count()) || grid.values.empty())
    throw InputError("decompose: " + std::to_string(grid.count()) + " distances expected, got " +
                     std::to_string(grid.values.size()));
  const NodeField field = parts::node_field(grid);
  Decomposition result;
  result.spacing = field.spacing;
  result.epsilon = parts::kHalfDiagonal * field.spacing;
  result.nodes = field.count();
  result.inside = std::count_if(field.depth.begin(), field.depth.end(),
                                [](float depth) { return depth > 0.0F; });
  result.volume = static_cast<double>(result.inside) * std::pow(field.spacing, 3);
  if (result.inside == 0)
    throw InputError("decompose: none of the grid's " + std::to_string(result.nodes) +
                     " nodes lies inside the solid; take a finer grid");
  const std::vector<GridBall> inner = inner_balls(field, options);
  const double growth = options.expansion * parts::kHalfDiagonal;  // in spacings
  std::vector<GridBall> grown(inner), knots;
  for (GridBall& ball : grown) ball.radius += growth;
  for (const std::size_t i : reduced(field, inner, grown, growth, options))
    knots.push_back(grown[i]);
  const parts::BoundaryPoints boundary(field);
  const std::vector<GridBall> more = parts::boundary_balls(boundary, knots, grown, growth);
  knots.insert(knots.end(), more.begin(), more.end());
  if (options.reduction == Reduction::kCover)
    knots = parts::without_needless(field, boundary, std::move(knots));
  std::stable_sort(knots.begin(), knots.end(),
                   [](const GridBall& a, const GridBall& b) { return a.radius > b.radius; });
  result.coverage = parts::covered_part(field, knots);

  result.inner.resize(4, static_cast<Eigen::Index>(inner.size()));
  for (Eigen::Index i = 0; i < result.inner.cols(); ++i)
    result.inner.col(i) = in_solid_frame(field, inner[i]);
  result.knots.points.resize(4, static_cast<Eigen::Index>(knots.size()));
  for (Eigen::Index i = 0; i < result.knots.size(); ++i)
    result.knots.points.col(i) = in_solid_frame(field, knots[i]);
  result.added =
      std::count_if(knots.begin(), knots.end(), [](const GridBall& b) { return b.added; });
  result.knots.weights = Eigen::VectorXcd::Ones(result.knots.size());
  if (options.weights == KnotWeights::kShare) {
    const std::vector<double> shares = parts::shares(field, knots);
    for (Eigen::Index i = 0; i < result.knots.size(); ++i) result.knots.weights[i] = shares[i];
  }
  return result;
}

}  // namespace mortise
