// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// How far a part lies from where it belongs.
#pragma once

#include <memory>

#include "mortise/core/rigid_motion.hpp"
#include "mortise/metrics/true_mates.hpp"
#include "mortise/parts/triangle_mesh.hpp"

namespace mortise {

/// Distances between corresponding points of the moving part's surface at a pose and at the true
/// placement nearest to it, relative to the part's diameter.
struct PlacementError {
  double largest = 0.0;  ///< over the whole surface
  double rms = 0.0;      ///< over the surface by area
};

/// Measures poses of one part against its true placements.
///
/// Both distances are minimised over the recorded symmetries, each by itself. The mean square is
/// exact (a quadratic over each triangle, summed by mid-edge points) and smooth in the symmetries'
/// parameters: a grid of starts, then damped Newton steps. The largest distance is taken at a
/// vertex; it descends by a pattern search from the mean square's minima, those of every fold.
class Placement {
 public:
  /// @throws InputError if the mesh has no triangle or a symmetry is out of range
  Placement(const TriangleMesh& moving, const TrueMate& truth);
  ~Placement();
  Placement(Placement&&) noexcept;
  Placement& operator=(Placement&&) noexcept;

  /// Thread safe. Time: about a millisecond per pose and family of one parameter.
  [[nodiscard]] PlacementError error(const RigidMotion& moving_in_fixed) const;
  /// The true placement whose mean square distance from the pose is least.
  [[nodiscard]] RigidMotion nearest(const RigidMotion& moving_in_fixed) const;
  [[nodiscard]] double diameter() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace mortise
