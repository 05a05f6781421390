// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The solid a triangle mesh bounds: nearest points, signed distance, winding number.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <memory>

#include "mortise/parts/solid.hpp"
#include "mortise/parts/triangle_mesh.hpp"

namespace mortise {

struct TriangleTree;

struct MeshSolidOptions {
  /// Farther than this many times its radius a cluster of triangles counts by its moments, nearer
  /// its triangles count singly; >= 1, infinity = the exact sum. At 2, errors are below 0.01.
  double winding_reach = 2.0;
  int threads = 0;  ///< for calls with many points; 0 = all cores; never changes the result
};

/// The nearest points of a mesh to N points.
struct NearestPoints {
  Eigen::Matrix3Xd points;    ///< 3 x N, on the mesh
  Eigen::VectorXi triangles;  ///< N: the triangles they lie on; on an edge, any that shares it
  Eigen::VectorXd distances;  ///< N, >= 0
};

/// A triangle mesh as a solid. Inside is where the winding number is above 1/2. For a closed mesh
/// whose triangles face outward that is the usual inside. Overlapping shells unite, but distances
/// are to the whole mesh, buried parts of it included. The holes of an open mesh are closed by a
/// surface without creases.
///
/// Holds the mesh and a search tree, together about 250 bytes per triangle; copies share both. Safe
/// to call from several threads at once.
class MeshSolid : public Solid {
 public:
  /// @throws InputError if there is no triangle, an index is out of range, a vertex in use is not
  /// finite or an option is out of range
  explicit MeshSolid(TriangleMesh mesh, const MeshSolidOptions& options = {});

  [[nodiscard]] Eigen::AlignedBox3d bounds() const override;

  /// Exact up to the rounding of doubles, negative inside; see Solid. Faster where points that are
  /// next to each other in the list are near each other in space.
  /// @throws InputError if a point is not finite or `band` is not > 0
  [[nodiscard]] Eigen::VectorXd signed_distance(const Eigen::Matrix3Xd& points,
                                                double band) const override;

  /// How often the mesh winds around each point: 1 inside, 0 outside of a closed mesh that faces
  /// outward, in between for an open one [Barill et al. 2018]. On the surface, either side's.
  /// @param points  3 x N @throws InputError if a point is not finite
  [[nodiscard]] Eigen::VectorXd winding_number(const Eigen::Matrix3Xd& points) const;

  /// @param points  3 x N @throws InputError if a point is not finite
  [[nodiscard]] NearestPoints nearest(const Eigen::Matrix3Xd& points) const;

  /// Whether no edge is open: each is walked as often one way as the other, equal vertices counting
  /// as one. Then the winding number is a whole number everywhere off the surface.
  [[nodiscard]] bool closed() const noexcept;

  [[nodiscard]] const TriangleMesh& mesh() const noexcept;

  /// For the library's own use.
  [[nodiscard]] const TriangleTree& tree() const noexcept;

 private:
  struct State;
  std::shared_ptr<const State> state_;
};

}  // namespace mortise
