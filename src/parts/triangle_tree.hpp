// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A tree of boxes over triangles, eight children to a node and eight triangles to a leaf, laid out
/// for vector instructions. Types only (see cmake/MortiseIsa.cmake).
#pragma once

#include <cstddef>

namespace mortise {

constexpr int kTreeWidth = 8;
constexpr int kTreeMoments = 19;
constexpr int kTreeStack = 256;  ///< enough for every tree build_triangle_tree makes

/// Up to eight triangles side by side. Unused places repeat the last triangle; `count` are real.
struct alignas(64) TrianglePacket {
  double corner[3][kTreeWidth];
  double edge1[3][kTreeWidth];          ///< second corner - corner
  double edge2[3][kTreeWidth];          ///< third corner - corner
  double normal[3][kTreeWidth];         ///< unit, outward; 0 where the triangle has no area
  double inverse_edge1_sq[kTreeWidth];  ///< 0 where the edge has no length; likewise below
  double inverse_edge2_sq[kTreeWidth];
  double inverse_edge3_sq[kTreeWidth];  ///< edge3 = edge2 - edge1
  int triangle[kTreeWidth];
  int count;
};

/// What is known of eight children side by side.
///
/// The moments of a child's triangles, x on them, n their unit normal, c the centre, s = x - c:
///   0..2    Int n dA
///   3..8    the quadratic form Int (s.r)(n.r) dA by r_x^2, r_y^2, r_z^2, r_x r_y, r_x r_z, r_y r_z
///   9..18   the cubic form 1/2 Int (s.r)^2 (n.r) dA by xxx, yyy, zzz, xxy, xxz, yyx, yyz, zzx,
///   zzy,
///           xyz
/// They give Int (x - q).n psi(|x - q|) dA for any smooth psi to second order (docs/math.md).
struct alignas(64) TreeNode {
  double middle[3][kTreeWidth];   ///< of a box along the child's own principal axes
  double axis[3][3][kTreeWidth];  ///< the three axes, unit
  double half[3]
             [kTreeWidth];  ///< half sides; such that it is infinitely far where there is no child
  double centre[3][kTreeWidth];  ///< centroid of the child's surface
  double radius[kTreeWidth];     ///< of a ball about it that holds the child's triangles
  /// Covariance of the child's surface as a quadratic form by r_x^2, r_y^2, r_z^2, r_x r_y, r_x
  /// r_z, r_y r_z: how far it spreads along r.
  double spread[6][kTreeWidth];
  double moments[kTreeMoments][kTreeWidth];
  int child[kTreeWidth];  ///< a node if >= 0, else packet -1 - child
  int count;              ///< children there are, the first ones
};

/// Node 0 is the root.
struct TreeView {
  const TreeNode* nodes;
  const TrianglePacket* packets;
};

}  // namespace mortise
