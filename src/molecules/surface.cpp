// SPDX-License-Identifier: GPL-3.0-or-later
// Shrake-Rupley areas on a sorted cell list.
#include "mortise/molecules/surface.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "core/cell_list.hpp"
#include "core/sphere_points.hpp"
#include "molecules/check_balls.hpp"
#include "mortise/core/errors.hpp"
#include "mortise/core/threads.hpp"
#include "mortise/molecules/radii.hpp"

namespace mortise {
namespace {

/// A neighbour j hides the direction u of ball i if u . (x_j - x_i) > (R_i^2 + d^2 - R_j^2) / (2
/// R_i).
struct Cap {
  Eigen::Vector3d towards;
  double threshold = 0.0;
  double depth = 0.0;  ///< threshold / d, the cosine of the cap's half angle
};

void check(const Eigen::Matrix3Xd& centres, const Eigen::VectorXd& radii,
           const SurfaceOptions& options) {
  const std::string where = "accessible_areas: ";
  check_balls(where, centres, radii);
  if (!(options.probe_radius >= 0.0 && std::isfinite(options.probe_radius)))
    throw InputError(where + "probe_radius must be >= 0, got " +
                     std::to_string(options.probe_radius));
  if (options.points_per_atom < 1)
    throw InputError(where + "points_per_atom must be >= 1, got " +
                     std::to_string(options.points_per_atom));
}

/// Calls visit(ball, directions) for each ball with points that no other ball hides, from any
/// thread; `directions` are their columns of `points`, rising.
template <typename Visit>
void for_each_exposed(const Eigen::Matrix3Xd& centres, const Eigen::VectorXd& grown,
                      const Eigen::Matrix3Xd& points, int threads, const Visit& visit) {
  const detail::CellList cells(centres, 2.0 * grown.maxCoeff());

  const auto find_exposed = [&](int i, const std::vector<int>& around, std::vector<Cap>& caps,
                                std::vector<Eigen::Index>& exposed) {
    const double radius = grown[i];
    caps.clear();
    exposed.clear();
    for (const int j : around) {
      if (j == i) continue;
      const Eigen::Vector3d d = centres.col(j) - centres.col(i);
      const double reach = radius + grown[j];
      const double d_sq = d.squaredNorm();
      if (d_sq >= reach * reach) continue;
      const double threshold = (radius * radius + d_sq - grown[j] * grown[j]) / (2.0 * radius);
      const double distance = std::sqrt(d_sq);
      if (distance == 0.0 ? grown[j] > radius || (grown[j] == radius && j < i)
                          : threshold <= -distance)
        return;  // i lies within j; of identical balls the first keeps the surface
      if (threshold >= distance || distance == 0.0) continue;  // j lies within i and hides nothing
      caps.push_back({d, threshold, threshold / distance});
    }
    // The widest caps first: most hidden points are then found at the first test or two.
    std::sort(caps.begin(), caps.end(),
              [](const Cap& a, const Cap& b) { return a.depth < b.depth; });
    std::size_t last =
        0;  // points follow each other round the ball, so the last cap often hides the next one too
    for (Eigen::Index p = 0; p < points.cols(); ++p) {
      const Eigen::Vector3d u = points.col(p);
      const auto hides = [&](const Cap& cap) { return u.dot(cap.towards) > cap.threshold; };
      if (last < caps.size() && hides(caps[last])) continue;
      last = static_cast<std::size_t>(std::find_if(caps.begin(), caps.end(), hides) - caps.begin());
      if (last == caps.size()) exposed.push_back(p);
    }
  };

  constexpr std::size_t kCellsPerTask = 32;
  const std::size_t tasks =
      (static_cast<std::size_t>(cells.cells()) + kCellsPerTask - 1) / kCellsPerTask;
  parallel_for(tasks, threads, [&](std::size_t task, int) {
    std::vector<int> around;
    std::vector<Cap> caps;
    std::vector<Eigen::Index> exposed;
    const auto begin = static_cast<std::int32_t>(task * kCellsPerTask);
    const std::int32_t end =
        std::min(cells.cells(), begin + static_cast<std::int32_t>(kCellsPerTask));
    for (std::int32_t cell = begin; cell < end; ++cell) {
      around.clear();
      for (const std::int32_t c : cells.cells_around(cell))
        around.insert(around.end(), cells.points_in(c).begin(), cells.points_in(c).end());
      for (const std::int32_t i : cells.points_in(cell)) {
        if (!(grown[i] > 0.0)) continue;
        find_exposed(i, around, caps, exposed);
        if (!exposed.empty()) visit(i, exposed);
      }
    }
  });
}

double area_of(double radius, std::size_t points, const SurfaceOptions& options) {
  return 4.0 * std::numbers::pi * radius * radius * static_cast<double>(points) /
         options.points_per_atom;
}

}  // namespace

Eigen::VectorXd accessible_areas(const Eigen::Matrix3Xd& centres, const Eigen::VectorXd& radii,
                                 const SurfaceOptions& options) {
  check(centres, radii, options);
  Eigen::VectorXd areas = Eigen::VectorXd::Zero(radii.size());
  if (radii.size() == 0) return areas;
  const Eigen::VectorXd grown = radii.array() + options.probe_radius;
  for_each_exposed(centres, grown, detail::fibonacci_sphere(options.points_per_atom),
                   options.threads, [&](int i, const std::vector<Eigen::Index>& exposed) {
                     areas[i] = area_of(grown[i], exposed.size(), options);
                   });
  return areas;
}

Eigen::VectorXd accessible_areas(const Molecule& molecule, const SurfaceOptions& options) {
  return accessible_areas(atom_positions(molecule), atom_radii(molecule), options);
}

AccessiblePoints accessible_points(const Eigen::Matrix3Xd& centres, const Eigen::VectorXd& radii,
                                   const SurfaceOptions& options) {
  check(centres, radii, options);
  AccessiblePoints out;
  out.areas = Eigen::VectorXd::Zero(radii.size());
  out.first.assign(static_cast<std::size_t>(radii.size()) + 1, 0);
  if (radii.size() == 0) return out;
  const Eigen::VectorXd grown = radii.array() + options.probe_radius;
  const Eigen::Matrix3Xd points = detail::fibonacci_sphere(options.points_per_atom);
  std::vector<std::vector<Eigen::Index>> directions(static_cast<std::size_t>(radii.size()));
  for_each_exposed(
      centres, grown, points, options.threads,
      [&](int i, const std::vector<Eigen::Index>& exposed) { directions[i] = exposed; });
  for (std::size_t i = 0; i < directions.size(); ++i)
    out.first[i + 1] = out.first[i] + static_cast<Eigen::Index>(directions[i].size());
  out.positions.resize(3, out.first.back());
  Eigen::Index column = 0;
  for (Eigen::Index i = 0; i < radii.size(); ++i) {
    out.areas[i] = area_of(grown[i], 1, options);
    for (const Eigen::Index p : directions[i])
      out.positions.col(column++) = centres.col(i) + grown[i] * points.col(p);
  }
  return out;
}

}  // namespace mortise
