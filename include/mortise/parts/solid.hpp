// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What a spherical decomposition asks of a body: where it lies, how far its boundary is, which
/// side.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace mortise {

/// Anything that answers distance and inclusion: a mesh, a molecule's surface, an analytic shape.
class Solid {
 public:
  virtual ~Solid() = default;

  /// A box that holds the body, in its own frame.
  [[nodiscard]] virtual Eigen::AlignedBox3d bounds() const = 0;

  /// Signed distance to the boundary at each point, negative inside; length unit of the body.
  /// @param points  3 x N, the body's own frame
  /// @param band    where the distance is certain to be larger, any value of the right sign and at
  ///                least `band` in size may be given; infinity = exact everywhere
  /// Safe to call from several threads at once.
  [[nodiscard]] virtual Eigen::VectorXd signed_distance(const Eigen::Matrix3Xd& points,
                                                        double band) const = 0;

 protected:
  Solid() = default;
  Solid(const Solid&) = default;
  Solid& operator=(const Solid&) = default;
};

}  // namespace mortise
