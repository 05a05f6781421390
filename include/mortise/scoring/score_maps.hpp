// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A body's potential on a grid: scoring a pose in microseconds.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "mortise/core/rigid_motion.hpp"
#include "mortise/scoring/contact_potential.hpp"
#include "mortise/scoring/pose_scorer.hpp"
#include "mortise/scoring/shape_kernel.hpp"

namespace mortise {

/// Points with a type each; a negative type takes no part.
struct TypedPoints {
  Eigen::Matrix3Xd points;  ///< 3 x N, the body's input frame, angstrom
  Eigen::VectorXi types;    ///< N
};

struct ScoreMapsOptions {
  double spacing = 1.0;  ///< of the grid, angstrom; > 0
  int threads = 0;       ///< 0 = all cores; never changes the result
};

/// A moving body as ScoreMaps::smooth_score reads it: one entry per point, the typed ones first.
struct PlacedPoints {
  /// @param shape  3 x N centres of the knots and their N weights; may share places with `typed`,
  /// which then become one entry
  /// @throws InputError if counts do not agree or there is no point
  PlacedPoints(const TypedPoints& typed, const Eigen::Matrix3Xd& shape_points,
               const Eigen::VectorXd& shape_weights);

  Eigen::Vector3d centre;   ///< mean of the shape's points, the body's input frame
  double gyration;          ///< their rms distance from it, angstrom; 1 if less
  Eigen::VectorXd x, y, z;  ///< entries' places from the centre, angstrom
  Eigen::VectorXi types;    ///< -1 = none
  Eigen::VectorXd weights;  ///< of the shape term; 0 = none
};

/// For each type the potential that the fixed body's points make, on a grid around it, and the
/// shape score's, if asked for.
///
/// Interpolation errs by at most about spacing^2 / 8 times the kernels' curvature, which is
/// concentrated in their corners; at 1 angstrom a pose's score errs by about 2% (docs/math.md).
class ScoreMaps {
 public:
  /// @throws InputError if a type is not below the potential's, a size does not fit, or an option
  /// is out of range
  ScoreMaps(const TypedPoints& fixed, const ContactPotential& potential,
            const ScoreMapsOptions& options = {});

  /// With a map for the shape score, sum_i w_i kernel(|x - x_i|) of these knots.
  /// @throws InputError as above, or if points and weights do not agree
  ScoreMaps(const TypedPoints& fixed, const ContactPotential& potential,
            const Eigen::Matrix3Xd& shape_points, const Eigen::VectorXd& shape_weights,
            const TabulatedKernel& shape_kernel, const ScoreMapsOptions& options = {});

  /// sum_ij near K1 + far K2 over fixed points i and moved points j; without the shape term.
  /// Interpolated linearly in each axis. Time O(moving points within range). Thread safe.
  [[nodiscard]] double score(const TypedPoints& moving, const RigidMotion& moving_in_fixed) const;

  /// Shape and contact terms together, interpolated by cubics that agree with the maps at grid
  /// points and have continuous slopes [R. G. Keys, IEEE Trans. ASSP 29 (1981) 1153-1160], and the
  /// exact derivatives of that. Thread safe.
  /// @throws InputError if there is no map for the shape or a type is not one of the potential's
  [[nodiscard]] PlacedScore smooth_score(const PlacedPoints& moving,
                                         const RigidMotion& moving_in_fixed) const;

  /// The two terms of smooth_score's value: shape, contact.
  [[nodiscard]] std::array<double, 2> smooth_terms(const PlacedPoints& moving,
                                                   const RigidMotion& moving_in_fixed) const;

 private:
  [[nodiscard]] PlacedScore smooth(const PlacedPoints& moving, const RigidMotion& moving_in_fixed,
                                   double contact, double shape) const;
  void lay_out(const Eigen::Matrix3Xd& points, double margin);
  [[nodiscard]] std::size_t cells() const;
  template <class Visit>
  void visit_plane(std::size_t i, const Eigen::Vector3d& point, double range,
                   const Visit& visit) const;
  void fill_contacts(const TypedPoints& fixed, const ContactPotential& potential, int threads);
  void fill_shape(const Eigen::Matrix3Xd& points, const Eigen::VectorXd& weights,
                  const TabulatedKernel& kernel, int threads);
  void mark_nearby();

  std::array<int, 3> size_;
  Eigen::Vector3d low_;  // of grid point 0
  double spacing_;
  int types_;
  bool has_shape_ = false;
  std::vector<float> values_;         // (types + shape) x nx x ny x nz
  std::vector<std::uint8_t> nearby_;  // nx x ny x nz: 1 = a value of the cell's stencil is not 0
};

/// The same score by the sum over all pairs: slow, exact.
[[nodiscard]] double contact_score(const TypedPoints& fixed, const TypedPoints& moving,
                                   const RigidMotion& moving_in_fixed,
                                   const ContactPotential& potential);

}  // namespace mortise
