// SPDX-License-Identifier: GPL-3.0-or-later
// The solvent-excluded body from its definition: all that is farther than the probe's radius from
// every place its centre can be. Slow and obviously right.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace mortise::test {

class SlowSolventExcluded {
 public:
  SlowSolventExcluded(const Eigen::Matrix3Xd& centres, const Eigen::VectorXd& radii, double probe)
      : centres_(centres), grown_(radii.array() + probe), probe_(probe) {
    // Where three grown spheres meet: by trilateration, in the frame of the first two centres.
    for (Eigen::Index i = 0; i < size(); ++i)
      for (Eigen::Index j = 0; j < i; ++j)
        for (Eigen::Index k = 0; k < j; ++k) {
          const Eigen::Vector3d ij = centres.col(j) - centres.col(i);
          const Eigen::Vector3d ik = centres.col(k) - centres.col(i);
          const Eigen::Vector3d ex = ij.normalized(), ey = (ik - ik.dot(ex) * ex).normalized();
          const double d = ij.norm(), u = ik.dot(ex), v = ik.dot(ey);
          const double x = (sq(grown_[i]) - sq(grown_[j]) + d * d) / (2.0 * d);
          const double y = (sq(grown_[i]) - sq(grown_[k]) + u * u + v * v) / (2.0 * v) - u / v * x;
          const double z_sq = sq(grown_[i]) - x * x - y * y;
          if (!(z_sq > 0.0)) continue;
          for (const double z : {std::sqrt(z_sq), -std::sqrt(z_sq)}) {
            const Eigen::Vector3d p = centres.col(i) + x * ex + y * ey + z * ex.cross(ey);
            if (free(p)) corners_.push_back(p);
          }
        }
  }

  // Distance of x from the nearest grown ball; < 0: it lies in one.
  [[nodiscard]] double clearance(const Eigen::Vector3d& x) const {
    return ((centres_.colwise() - x).colwise().norm().transpose() - grown_).minCoeff();
  }

  // Distance from x to the nearest place where the probe's centre can be. That place is x itself,
  // or the nearest of a sphere, of a circle in which two meet, or of the points where three do.
  [[nodiscard]] double distance_to_free(const Eigen::Vector3d& x) const {
    if (free(x)) return 0.0;
    double best = std::numeric_limits<double>::infinity();
    const auto offer = [&](const Eigen::Vector3d& p) {
      const double distance = (p - x).norm();
      if (distance < best && free(p)) best = distance;
    };
    for (const Eigen::Vector3d& p : corners_) best = std::min(best, (p - x).norm());
    for (Eigen::Index i = 0; i < size(); ++i) {
      const Eigen::Vector3d c = centres_.col(i);
      offer(c + grown_[i] * (x - c).normalized());
      for (Eigen::Index j = 0; j < i; ++j) {
        const Eigen::Vector3d axis = (centres_.col(j) - c).normalized();
        const double d = (centres_.col(j) - c).norm();
        const double along = (d * d + sq(grown_[i]) - sq(grown_[j])) / (2.0 * d);
        const double ring_sq = sq(grown_[i]) - along * along;
        if (!(ring_sq > 0.0)) continue;
        const Eigen::Vector3d out = (x - c) - (x - c).dot(axis) * axis;
        offer(c + along * axis + std::sqrt(ring_sq) * out.normalized());
      }
    }
    return best;
  }
  [[nodiscard]] bool inside(const Eigen::Vector3d& x) const { return distance_to_free(x) > probe_; }

  // Volume by counting the points of a cubic grid.
  [[nodiscard]] double volume(double step) const {
    const Eigen::Vector3d low =
        (centres_.rowwise().minCoeff().array() - grown_.maxCoeff()).matrix();
    const Eigen::Vector3d high =
        (centres_.rowwise().maxCoeff().array() + grown_.maxCoeff()).matrix();
    const Eigen::Vector3i counts = ((high - low) / step).array().ceil().cast<int>();
    long found = 0;
    for (int i = 0; i < counts[0]; ++i)
      for (int j = 0; j < counts[1]; ++j)
        for (int k = 0; k < counts[2]; ++k)
          found += inside(low + step * Eigen::Vector3d(i + 0.5, j + 0.5, k + 0.5)) ? 1 : 0;
    return static_cast<double>(found) * step * step * step;
  }

 private:
  [[nodiscard]] static double sq(double x) { return x * x; }
  [[nodiscard]] Eigen::Index size() const { return centres_.cols(); }
  [[nodiscard]] bool free(const Eigen::Vector3d& x) const { return clearance(x) > -1e-9; }

  Eigen::Matrix3Xd centres_;
  Eigen::VectorXd grown_;
  double probe_;
  std::vector<Eigen::Vector3d> corners_;
};

}  // namespace mortise::test
