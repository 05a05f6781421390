// SPDX-License-Identifier: GPL-3.0-or-later
// Buried balls merged into larger ones by a greedy cover.
#include "mortise/molecules/merge_buried.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <string>
#include <vector>

#include "core/point_grid.hpp"
#include "mortise/core/errors.hpp"
#include "mortise/molecules/surface.hpp"

namespace mortise {
namespace {

constexpr int kPointsPerBall = 200;

void check_options(const MergeBuriedOptions& o) {
  const auto refuse = [](const char* name, const char* range, double value) {
    throw InputError(std::string("merge_buried: ") + name + " must be " + range + ", got " +
                     std::to_string(value));
  };
  if (!(o.largest > 0.0) || !std::isfinite(o.largest)) refuse("largest", "> 0", o.largest);
  if (!(o.probe >= 0.0) || !std::isfinite(o.probe)) refuse("probe", ">= 0", o.probe);
  if (!(o.offset >= 0.0) || !std::isfinite(o.offset)) refuse("offset", ">= 0", o.offset);
  if (o.least < 2) refuse("least", ">= 2", o.least);
}

// Radius of the largest ball about each centre that the solvent-excluded volume holds, `largest` at
// most; below 0 near the surface.
Eigen::VectorXd room_about(const Knots& knots, const MergeBuriedOptions& options) {
  const AccessiblePoints surface = accessible_points(knots.points.topRows<3>(), knots.points.row(3),
                                                     {.probe_radius = options.probe,
                                                      .points_per_atom = kPointsPerBall,
                                                      .threads = options.threads});
  const double reach = options.largest + options.probe;
  const detail::PointGrid points(surface.positions, reach, reach);
  Eigen::VectorXd room(knots.size());
  for (Eigen::Index i = 0; i < knots.size(); ++i) {
    const Eigen::Vector3d centre = knots.points.col(i).head<3>();
    double nearest_sq = reach * reach;
    points.for_each_near(centre, [&](int p) {
      nearest_sq = std::min(nearest_sq, (surface.positions.col(p) - centre).squaredNorm());
    });
    room[i] = std::sqrt(nearest_sq) - options.probe;
  }
  return room;
}

}  // namespace

Knots merge_buried(const Knots& knots, const MergeBuriedOptions& options) {
  check_knots(knots, "merge_buried");
  check_options(options);
  const Eigen::VectorXd room = room_about(knots, options);

  // What a ball about each centre contains; the contained must have room for themselves there.
  std::vector<std::vector<int>> inside(static_cast<std::size_t>(knots.size()));
  std::vector<std::vector<int>> holders(inside.size());
  const detail::PointGrid centres(knots.points.topRows<3>(), options.largest, options.largest);
  for (Eigen::Index i = 0; i < knots.size(); ++i) {
    if (room[i] <= knots.points(3, i)) continue;
    const Eigen::Vector3d centre = knots.points.col(i).head<3>();
    centres.for_each_near(centre, [&](int j) {
      const double distance = (knots.points.col(j).head<3>() - centre).norm();
      if (distance + knots.points(3, j) > room[i]) return;
      inside[static_cast<std::size_t>(i)].push_back(j);
      holders[static_cast<std::size_t>(j)].push_back(static_cast<int>(i));
    });
  }

  std::vector<int> open(inside.size());  // how many of a ball's contents are not merged yet
  for (std::size_t i = 0; i < inside.size(); ++i) open[i] = static_cast<int>(inside[i].size());
  std::vector<char> merged(inside.size(), 0);
  std::vector<Eigen::Vector4d> balls;
  std::vector<std::complex<double>> weights;
  const auto grown = [&](double radius) { return std::pow(radius + options.offset, 3); };
  while (true) {
    const std::size_t best = static_cast<std::size_t>(std::max_element(open.begin(), open.end()) -
                                                      open.begin());  // the first of equals
    if (open[best] < options.least) break;
    const auto at = static_cast<Eigen::Index>(best);
    std::complex<double> weight = 0.0;
    for (const int j : inside[best]) {
      if (merged[static_cast<std::size_t>(j)] != 0) continue;
      merged[static_cast<std::size_t>(j)] = 1;
      weight += knots.weights[j] * grown(knots.points(3, j)) / grown(room[at]);
      for (const int holder : holders[static_cast<std::size_t>(j)])
        --open[static_cast<std::size_t>(holder)];
    }
    balls.emplace_back(knots.points(0, at), knots.points(1, at), knots.points(2, at), room[at]);
    weights.push_back(weight);
  }

  const auto kept = std::count(merged.begin(), merged.end(), 0);
  const Eigen::Index count = kept + static_cast<Eigen::Index>(balls.size());
  Knots result{Eigen::Matrix4Xd(4, count), Eigen::VectorXcd(count)};
  Eigen::Index next = 0;
  for (Eigen::Index i = 0; i < knots.size(); ++i) {
    if (merged[static_cast<std::size_t>(i)] != 0) continue;
    result.points.col(next) = knots.points.col(i);
    result.weights[next++] = knots.weights[i];
  }
  for (std::size_t b = 0; b < balls.size(); ++b, ++next) {
    result.points.col(next) = balls[b];
    result.weights[next] = weights[b];
  }
  return result;
}

}  // namespace mortise
