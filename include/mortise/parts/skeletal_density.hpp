// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The skeletal density of a part: large where many points of its surface are nearly nearest.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <vector>

#include "mortise/parts/distance_grid.hpp"
#include "mortise/parts/mesh_solid.hpp"

namespace mortise {

struct SkeletalDensityOptions {
  /// sigma: how much further than the nearest one a surface point may be, relative to its distance,
  /// and still count; 0.01 to 4. The smaller, the sharper the skeleton.
  double thickness = 0.5;
  double exterior = 1.0;  ///< lambda_1, the weight outside; finite
  double penalty = 3.0;   ///< p = lambda_2 / lambda_1, the weight inside over that outside; finite
  /// Error aimed at, 0.005 to 0.1: relative to the value, or where that is smaller to a tenth of a
  /// flat wall's (pi / 2 lambda).
  /// The largest error seen over many shapes and thicknesses is 0.73 of the aim.
  double tolerance = 0.01;
  int threads = 0;  ///< 0 = all cores; never changes the result
};

/// Skeletal density at grid nodes, dimensionless.
struct SkeletalDensity : GridNodes {
  std::vector<std::complex<float>> values;  ///< count() of them, by index()
};

/// The skeletal density of a mesh's solid [HA, Eq. 2-3],
///
///   rho(p) = lambda(p) Int zeta^-2 g_sigma(|tan arg zeta| - 1) dA_perp,   zeta = xi(p) + i |x -
///   p|,
///
/// over the surface, xi the signed distance (negative inside), g_sigma the normalised Gaussian,
/// dA_perp = (x - p).n / |x - p| dA; lambda = +lambda_1 outside, -lambda_2 = -p lambda_1 inside.
/// Along the skeleton the imaginary part is positive outside and negative inside. In the real part
/// of a product of two densities, the inside of one on the outside of the other therefore counts in
/// favour; inside on inside and outside on outside count against. 0 on the surface itself.
/// Derivation in docs/math.md.
///
/// @param distances  of the same solid, exact everywhere (no band)
/// @throws InputError if an option is out of range or the grid is empty
[[nodiscard]] SkeletalDensity skeletal_density(const MeshSolid& solid,
                                               const DistanceGrid& distances,
                                               const SkeletalDensityOptions& options = {});

/// The same where the distances are not known yet.
[[nodiscard]] SkeletalDensity skeletal_density(const MeshSolid& solid, const GridNodes& nodes,
                                               const SkeletalDensityOptions& options = {});

/// The same at any points.
/// @param points  3 x N, the part's frame @throws InputError if an option is out of range or a
/// point is not finite
[[nodiscard]] Eigen::VectorXcd skeletal_density_at(const MeshSolid& solid,
                                                   const Eigen::Matrix3Xd& points,
                                                   const SkeletalDensityOptions& options = {});

}  // namespace mortise
