// SPDX-License-Identifier: GPL-3.0-or-later
// Exposed areas of spheres by exact arcs on many latitudes (the slices of Lee and Richards): slow
// and obviously right.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace mortise::test {

/// Length of [0, 2 pi) that no interval covers; the intervals may wrap.
inline double uncovered(std::vector<std::pair<double, double>> intervals) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  std::vector<std::pair<double, double>> parts;
  for (auto [from, to] : intervals) {
    const double shift = std::floor(from / kTurn) * kTurn;
    from -= shift;
    to -= shift;
    parts.emplace_back(from, std::min(to, kTurn));
    if (to > kTurn) parts.emplace_back(0.0, to - kTurn);
  }
  std::sort(parts.begin(), parts.end());
  double free = 0.0, reached = 0.0;
  for (const auto& [from, to] : parts) {
    free += std::max(0.0, from - reached);
    reached = std::max(reached, to);
  }
  return free + std::max(0.0, kTurn - reached);
}

/// Area of each sphere outside all others; midpoint rule over `latitudes`, exact along each of
/// them.
inline Eigen::VectorXd sphere_areas_by_latitudes(const Eigen::Matrix3Xd& centres,
                                                 const Eigen::VectorXd& radii, int latitudes) {
  Eigen::VectorXd areas(radii.size());
  for (Eigen::Index i = 0; i < radii.size(); ++i) {
    const double step = 2.0 * radii[i] / latitudes;
    double area = 0.0;
    for (int k = 0; k < latitudes; ++k) {
      const double z = -radii[i] + (k + 0.5) * step;
      const double ring = std::sqrt(radii[i] * radii[i] - z * z);
      bool hidden = false;
      std::vector<std::pair<double, double>> arcs;
      for (Eigen::Index j = 0; j < radii.size() && !hidden; ++j) {
        if (j == i) continue;
        const Eigen::Vector3d d = centres.col(j) - centres.col(i);
        // Sphere j cuts the plane of the ring in a disc of radius s, its centre at distance w.
        const double s_sq = radii[j] * radii[j] - (d.z() - z) * (d.z() - z);
        if (s_sq <= 0.0) continue;
        const double w = std::hypot(d.x(), d.y());
        if (w + ring <= std::sqrt(s_sq)) {
          hidden = true;
        } else if (w > 0.0) {
          const double cosine = (ring * ring + w * w - s_sq) / (2.0 * ring * w);
          if (cosine >= 1.0 || cosine <= -1.0) continue;  // apart, or the disc within the ring
          const double middle = std::atan2(d.y(), d.x()), half = std::acos(cosine);
          arcs.emplace_back(middle - half, middle + half);
        }
      }
      if (!hidden) area += radii[i] * step * uncovered(std::move(arcs));
    }
    areas[i] = area;
  }
  return areas;
}

}  // namespace mortise::test
