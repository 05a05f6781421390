// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A part's surface as triangles that share their vertices.
#pragma once

#include <Eigen/Core>

namespace mortise {

/// Triangles by index into the vertices; seen from outside the part, corners run counter-clockwise.
struct TriangleMesh {
  Eigen::Matrix3Xd vertices;   ///< 3 x V, in the part's own frame and length unit
  Eigen::Matrix3Xi triangles;  ///< 3 x T, indices of vertices, each in [0, V)

  [[nodiscard]] Eigen::Index size() const noexcept { return triangles.cols(); }
};

}  // namespace mortise
