// SPDX-License-Identifier: GPL-3.0-or-later
// Balls around and inside a solid from its spherical decomposition.
#include "mortise/collision/collision_body.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "mortise/core/errors.hpp"
#include "mortise/parts/decompose.hpp"
#include "mortise/parts/distance_grid.hpp"
#include "mortise/parts/sphere_tree.hpp"
#include "parts/distances.hpp"
#include "parts/node_field.hpp"

namespace mortise {
namespace {

// An upper bound on h(p) = min_i |p - x_i| - s_i over the points p of the solid that is at most
// `tolerance` above the largest. h changes no faster than p: in a cell of half diagonal rho about q
// it is at most h(q) + rho, and if the solid reaches to within d of q, at least h(q) - d somewhere
// in it. Cells that the solid misses, or that cannot lift the bound, are done with; the others are
// cut in eight. At rho = tolerance / 2 none is left.
double cover_of(const Solid& solid, const Eigen::Matrix4Xd& balls, double tolerance, int threads) {
  const double lift = std::max(0.0, -balls.row(3).minCoeff());  // a sphere tree wants radii >= 0
  Eigen::Matrix4Xd lifted = balls;
  lifted.row(3).array() += lift;
  const SphereTree tree = sphere_tree(lifted);
  const Eigen::AlignedBox3d box = solid.bounds();
  double half = 0.5 * box.sizes().maxCoeff();
  Eigen::Matrix3Xd cells = box.center();
  double most = -std::numeric_limits<double>::infinity();
  while (cells.cols() > 0) {
    const double rho = std::sqrt(3.0) * half;
    const Eigen::VectorXd h = distance_to_union(tree, cells, threads).array() + lift;
    std::vector<Eigen::Index> open;
    for (Eigen::Index i = 0; i < h.size(); ++i)
      if (h[i] + rho > most + tolerance) open.push_back(i);
    const Eigen::VectorXd d = distances(solid, cells(Eigen::all, open), 1.001 * rho, threads);
    for (std::size_t i = 0; i < open.size(); ++i)
      if (d[i] <= rho) most = std::max(most, h[open[i]] - std::max(0.0, d[i]));
    std::vector<Eigen::Index> kept;
    for (std::size_t i = 0; i < open.size(); ++i)
      if (d[i] <= rho && h[open[i]] + rho > most + tolerance) kept.push_back(open[i]);
    half *= 0.5;
    Eigen::Matrix3Xd next(3, 8 * static_cast<Eigen::Index>(kept.size()));
    for (std::size_t i = 0; i < kept.size(); ++i)
      for (int corner = 0; corner < 8; ++corner)
        next.col(static_cast<Eigen::Index>(8 * i) + corner) =
            cells.col(kept[i]) + half * Eigen::Vector3d((corner & 1) != 0 ? 1.0 : -1.0,
                                                        (corner & 2) != 0 ? 1.0 : -1.0,
                                                        (corner & 4) != 0 ? 1.0 : -1.0);
    cells = std::move(next);
  }
  return most + tolerance;
}

// A cell's share by its node's distance: 0 or 1 beyond half a cell from the boundary.
BodyDensity cell_shares(const DistanceGrid& grid) {
  std::vector<std::complex<float>> shares(grid.values.size());
  for (std::size_t i = 0; i < shares.size(); ++i)
    shares[i] = static_cast<float>(
        std::clamp(0.5 - static_cast<double>(grid.values[i]) / grid.spacing, 0.0, 1.0));
  return density_of_samples(shares, {grid.size[0], grid.size[1], grid.size[2]}, grid.origin,
                            grid.spacing);
}

}  // namespace

CollisionBody collision_body(const Solid& solid, const CollisionBodyOptions& options) {
  if (options.grid < 2 || options.grid > 1024)
    throw InputError("collision_body: grid must be 2 to 1024 nodes, got " +
                     std::to_string(options.grid));
  if (!(options.deviation >= 0.0) || !std::isfinite(options.deviation))
    throw InputError("collision_body: deviation must be >= 0, got " +
                     std::to_string(options.deviation));
  const Eigen::AlignedBox3d box = solid.bounds();
  const DistanceGrid grid =
      distance_grid(solid, parts::cell_centers(box, options.grid), {.threads = options.threads});
  const Decomposition found = decompose(grid, {.threads = options.threads});
  CollisionBody body{found.knots, 0.0, cell_shares(grid)};
  Eigen::Matrix4Xd& balls = body.balls.points;
  balls.row(3) = -distances(solid, balls.topRows<3>(), std::numeric_limits<double>::infinity(),
                            options.threads)
                      .transpose();
  // Distances are exact but for the rounding of coordinates.
  const double hair = 1e-12 * (box.min().cwiseAbs() + box.max().cwiseAbs()).maxCoeff();
  const double cover =
      cover_of(solid, balls, found.epsilon / 8.0, options.threads) + options.deviation + hair;
  balls.row(3).array() += cover;
  body.margin = cover + options.deviation + hair;
  return body;
}

}  // namespace mortise
