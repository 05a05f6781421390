// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The skeletal density as it is written: every triangle halved until a fixed rule agrees with
/// itself.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "mortise/parts/triangle_mesh.hpp"

namespace mortise::reference {

struct SkeletalIntegrand {
  Eigen::Vector3d point;
  double xi;  ///< signed distance, negative inside
  double sigma;
  double tolerance;  ///< per accepted piece, absolute

  /// zeta^-2 g_sigma(|tan arg zeta| - 1) (x - p).n / |x - p|, n the normal (of any length)
  [[nodiscard]] std::complex<double> at(const Eigen::Vector3d& x, const Eigen::Vector3d& n) const {
    const Eigen::Vector3d r = x - point;
    const std::complex<double> zeta(xi, r.norm());
    const double u = (std::abs(std::tan(std::arg(zeta))) - 1.0) / sigma;
    const double g = std::exp(-0.5 * u * u) / (std::sqrt(2.0 * std::numbers::pi) * sigma);
    return g / (zeta * zeta) * r.dot(n) / r.norm();
  }

  /// Degree 2, by the middles of the edges.
  [[nodiscard]] std::complex<double> rule(const Eigen::Matrix3d& t,
                                          const Eigen::Vector3d& n) const {
    return (at(0.5 * (t.col(0) + t.col(1)), n) + at(0.5 * (t.col(1) + t.col(2)), n) +
            at(0.5 * (t.col(2) + t.col(0)), n)) /
           3.0;
  }

  [[nodiscard]] std::complex<double> over(const Eigen::Matrix3d& t, int depth = 0) const {
    const Eigen::Vector3d n = 0.5 * (t.col(1) - t.col(0)).cross(t.col(2) - t.col(0));
    const Eigen::Vector3d centre = t.rowwise().mean();
    const double radius = (t.colwise() - centre).colwise().norm().maxCoeff();
    const double size = std::abs(xi);
    if ((centre - point).norm() - radius > size * (1.0 + 7.0 * sigma)) return 0.0;  // g below 1e-10
    Eigen::Matrix3d quarter[4];
    const Eigen::Vector3d ab = 0.5 * (t.col(0) + t.col(1)), bc = 0.5 * (t.col(1) + t.col(2)),
                          ca = 0.5 * (t.col(2) + t.col(0));
    quarter[0] << t.col(0), ab, ca;
    quarter[1] << t.col(1), bc, ab;
    quarter[2] << t.col(2), ca, bc;
    quarter[3] << ab, bc, ca;
    if (radius < 0.5 * size * std::min(1.0, sigma)) {  // not before: it could miss a narrow peak
      std::complex<double> four = 0.0;
      for (const Eigen::Matrix3d& q : quarter) four += 0.25 * rule(q, n);
      if (std::abs(four - rule(t, n)) < tolerance || depth > 40) return four;
    }
    std::complex<double> sum = 0.0;
    for (const Eigen::Matrix3d& q : quarter) sum += over(q, depth + 1);
    return sum;
  }
};

/// Int zeta^-2 g_sigma(|tan arg zeta| - 1) dA_perp over the mesh; no lambda.
inline std::complex<double> skeletal_integral(const TriangleMesh& mesh,
                                              const Eigen::Vector3d& point, double xi, double sigma,
                                              double tolerance) {
  const SkeletalIntegrand integrand = {point, xi, sigma, tolerance};
  std::complex<double> sum = 0.0;
  for (Eigen::Index t = 0; t < mesh.size(); ++t) {
    Eigen::Matrix3d corners;
    for (int k = 0; k < 3; ++k) corners.col(k) = mesh.vertices.col(mesh.triangles(k, t));
    sum += integrand.over(corners);
  }
  return sum;
}

}  // namespace mortise::reference
