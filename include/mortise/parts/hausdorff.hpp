// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// How far a union of balls and a solid are apart, by dense sampling.
#pragma once

#include <Eigen/Core>

#include "mortise/parts/solid.hpp"
#include "mortise/parts/triangle_mesh.hpp"

namespace mortise {

/// Points on a mesh, so dense that each of its points is within `spacing` of one.
/// @return 3 x N @throws InputError unless spacing > 0 and the samples number less than 2^28
[[nodiscard]] Eigen::Matrix3Xd surface_samples(const TriangleMesh& mesh, double spacing);

/// Points on a solid's boundary: the nodes of a grid of that spacing near the boundary, moved onto
/// it along the distance's gradient. About one in spacing^2.
/// @return 3 x N @throws InputError unless spacing > 0
[[nodiscard]] Eigen::Matrix3Xd surface_samples(const Solid& solid, double spacing, int threads = 0);

struct HausdorffOptions {
  double spacing = 0.0;  ///< between samples of the balls, twice that between nodes in the solid's
                         ///< box; 0 = box / 200
  int threads = 0;       ///< 0 = all cores; never changes the result
};

/// Largest distances, each from samples of the first set to the second. A true one may be larger by
/// `spacing` at most (2 spacing for surface_to_balls) where it is taken near a boundary, by half a
/// diagonal of the nodes' grid, 0.87 `node_spacing`, elsewhere.
struct HausdorffDistance {
  double balls_beyond_solid = 0.0;  ///< from the union of the balls to the solid
  double solid_beyond_balls = 0.0;  ///< from the solid to the union of the balls
  double balls_to_surface = 0.0;    ///< from the union's boundary, its voids' too, to the solid's
  double surface_to_balls = 0.0;    ///< from the solid's boundary to that of the union
  double spacing = 0.0;             ///< of the boundaries' samples
  double node_spacing = 0.0;        ///< of the nodes in the solid's box; at most 512 a side, so it
                                    ///< may be more than 2 spacing
  Eigen::Index samples = 0;         ///< of both boundaries and of the nodes in solid or balls

  /// Of the two as sets of points: what [SD, Prop. 1-3] bound by epsilon.
  [[nodiscard]] double of_solids() const noexcept;
  /// Of their boundaries: larger where balls leave a void or fill a groove.
  [[nodiscard]] double of_surfaces() const noexcept;
};

/// Measures both ways.
/// @param balls    4 x N, N >= 1: centre and radius > 0, the solid's frame
/// @param surface  3 x M, M >= 1: points of the solid's boundary, such as surface_samples gives
/// @throws InputError if a set is empty or not finite or the spacing negative
[[nodiscard]] HausdorffDistance hausdorff_distance(const Eigen::Matrix4Xd& balls,
                                                   const Solid& solid,
                                                   const Eigen::Matrix3Xd& surface,
                                                   const HausdorffOptions& options = {});

}  // namespace mortise
