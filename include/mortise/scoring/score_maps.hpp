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

/// What the shape score of a fixed body is made of: Q terms, each a sum over knots of weights times
/// a kernel that depends on the knot's radius. One radius: one term with one kernel.
struct ShapeTerms {
  Eigen::Matrix3Xd points;    ///< 3 x N knots, the body's input frame
  Eigen::VectorXd weights;    ///< N
  Eigen::VectorXi kernel_of;  ///< N: which kernel of each term is the knot's
  std::vector<std::vector<TabulatedKernel>> kernels;  ///< Q terms, all of one range
};

/// One term for knots of one radius.
[[nodiscard]] ShapeTerms shape_terms(const Eigen::Matrix3Xd& points, const Eigen::VectorXd& weights,
                                     const TabulatedKernel& kernel);

/// A moving body as ScoreMaps reads it.
struct PlacedPoints {
  /// Typed points alone, for maps without a shape. Those without a type are left out.
  /// @throws InputError if counts do not agree or a coordinate is not finite
  explicit PlacedPoints(const TypedPoints& typed);

  /// @param shape_points   3 x N centres of the knots; may share places with `typed`, which then
  /// become one
  /// @param knot_weights  Q x N: of the knots in each of the fixed body's terms
  /// @throws InputError as above, or if there is no knot
  PlacedPoints(const TypedPoints& typed, const Eigen::Matrix3Xd& shape_points,
               const Eigen::MatrixXd& knot_weights);

  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< mean of the shape's points, else of the
                                                     ///< typed ones; the body's input frame
  double gyration = 1.0;                             ///< rms distance from it, angstrom; 1 if less
  int largest_type = -1;                             ///< of the points

  /// Points in groups of 16 near each other, the last one filled up with what has no weight.
  Eigen::Matrix<float, Eigen::Dynamic, 3> places;  ///< from the centre, angstrom
  Eigen::VectorXi types;                           ///< 0 where there is none
  Eigen::VectorXf contact_weights;                 ///< 1, or 0 = no type
  Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic> shape_weights;  ///< points x Q
  Eigen::Matrix<float, Eigen::Dynamic, 4> groups;  ///< balls around the groups, filled up to 16
};

/// For each type the potential that the fixed body's points make, on a grid around it, and the
/// shape score's, if asked for.
///
/// Between grid points it is linear along each axis, which errs by at most about spacing^2 / 8
/// times the kernels' curvature, concentrated in their corners: at 1 angstrom a pose's score errs
/// by about 2% (docs/math.md). Values are kept to 8 bits after the first, which adds a fiftieth of
/// that. The grid is stored only where something is, in bricks of 4 x 4 x 4 points that share their
/// faces, so that what a point reads of a map lies in 128 bytes.
class ScoreMaps {
 public:
  /// @throws InputError if a type is not below the potential's, a size does not fit, or an option
  /// is out of range
  ScoreMaps(const TypedPoints& fixed, const ContactPotential& potential,
            const ScoreMapsOptions& options = {});

  /// With a map for each term of the shape score.
  /// @throws InputError as above, or if the shape's counts do not agree
  ScoreMaps(const TypedPoints& fixed, const ContactPotential& potential, const ShapeTerms& shape,
            const ScoreMapsOptions& options = {});

  /// sum_ij near K1 + far K2 over fixed points i and moved points j; without the shape term.
  /// Thread safe.
  /// @throws InputError if a type is not one of the potential's
  [[nodiscard]] double contact_score(const PlacedPoints& moving,
                                     const RigidMotion& moving_in_fixed) const;
  /// Of many poses, gone through by place, which is faster: what they read is then near by.
  /// @param threads  0 = all cores; never changes the result
  [[nodiscard]] Eigen::VectorXd contact_scores(const PlacedPoints& moving,
                                               const std::vector<RigidMotion>& poses,
                                               int threads = 0) const;

  /// Shape and contact terms together, and the exact derivatives of that, which jump where a point
  /// goes from cell to cell. Thread safe.
  /// @throws InputError if the terms of the shape are not as many, or as above
  [[nodiscard]] PlacedScore slope(const PlacedPoints& moving,
                                  const RigidMotion& moving_in_fixed) const;

  /// The two terms of slope's value: shape, contact.
  [[nodiscard]] std::array<double, 2> terms(const PlacedPoints& moving,
                                            const RigidMotion& moving_in_fixed) const;

  /// Maps of the shape; 0 = slope() cannot be asked.
  [[nodiscard]] int shapes() const noexcept { return shapes_; }
  /// Bytes of the maps.
  [[nodiscard]] std::size_t bytes() const;

 private:
  ScoreMaps(const TypedPoints& fixed, const ContactPotential& potential, const ShapeTerms* shape,
            const ScoreMapsOptions& options);
  void lay_out(const Eigen::Matrix3Xd& points, double margin);
  void check(const PlacedPoints& moving) const;

  std::array<int, 3> size_ = {1, 1, 1};            // blocks of 3 x 3 x 3 cells
  Eigen::Vector3d low_ = Eigen::Vector3d::Zero();  // of grid point 0
  double spacing_;
  int types_, shapes_ = 0;
  std::vector<std::int32_t> blocks_;   // FieldMaps::blocks
  std::vector<std::uint16_t> values_;  // FieldMaps::values
};

/// The same score by the sum over all pairs: slow, exact.
[[nodiscard]] double contact_score(const TypedPoints& fixed, const TypedPoints& moving,
                                   const RigidMotion& moving_in_fixed,
                                   const ContactPotential& potential);

}  // namespace mortise
