// SPDX-License-Identifier: GPL-3.0-or-later
// Gaussian density on a grid.
#include "report/density_surface.hpp"

#include <algorithm>
#include <cmath>

#include "mortise/core/errors.hpp"
#include "mortise/parts/distance_grid.hpp"
#include "mortise/parts/surface_net.hpp"

namespace mortise::detail {
namespace {

constexpr double kSoftness = 1.3;
constexpr double kReach = 2.2;  // radii; a ball's density there is below 0.7%
constexpr double kMostPoints = 2e7;

// 1 less the density: negative inside.
DistanceGrid make_density(const Eigen::Matrix3Xd& centres, const Eigen::VectorXd& radii,
                          double spacing) {
  const double reach = kReach * radii.maxCoeff();
  const Eigen::Vector3d low = centres.rowwise().minCoeff().array() - reach;
  const Eigen::Vector3d extent =
      centres.rowwise().maxCoeff() - low + Eigen::Vector3d::Constant(reach);
  DistanceGrid density;
  density.origin = low;
  density.spacing = std::max(spacing, std::cbrt(extent.prod() / kMostPoints));
  density.size = (extent.array() / density.spacing).ceil().cast<int>() + 2;
  density.values.assign(static_cast<std::size_t>(density.count()), 1.0F);
  for (Eigen::Index a = 0; a < centres.cols(); ++a) {
    const Eigen::Array3d at = (centres.col(a) - low) / density.spacing;
    const double r = radii[a] / density.spacing;
    const double scale = -kSoftness / (r * r);
    const Eigen::Array3i from = (at - kReach * r).ceil().cast<int>().max(0);
    const Eigen::Array3i to = (at + kReach * r).floor().cast<int>().min(density.size - 1);
    for (int i = from[0]; i <= to[0]; ++i)
      for (int j = from[1]; j <= to[1]; ++j) {
        const double rest = (i - at[0]) * (i - at[0]) + (j - at[1]) * (j - at[1]);
        float* row = density.values.data() + density.index(i, j, 0);
        for (int k = from[2]; k <= to[2]; ++k)
          row[k] -=
              static_cast<float>(std::exp(kSoftness + scale * (rest + (k - at[2]) * (k - at[2]))));
      }
  }
  return density;
}

}  // namespace

TriangleMesh density_surface(const Eigen::Matrix3Xd& centres, const Eigen::VectorXd& radii,
                             double spacing) {
  if (centres.cols() == 0 || radii.size() != centres.cols() || !(radii.minCoeff() > 0.0))
    throw InputError("density_surface: expected one radius > 0 for each of at least one centre");
  if (!(spacing > 0.0))
    throw InputError("density_surface: spacing must be > 0, got " + std::to_string(spacing));
  return surface_net(make_density(centres, radii, spacing));
}

}  // namespace mortise::detail
