// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Making the tree of a mesh's triangles.
#pragma once

#include <vector>

#include "mortise/parts/triangle_mesh.hpp"
#include "parts/triangle_tree.hpp"

namespace mortise {

struct TriangleTree {
  std::vector<TreeNode> nodes;
  std::vector<TrianglePacket> packets;
  std::vector<int> packet_of;  ///< per triangle: where it lies

  [[nodiscard]] TreeView view() const noexcept { return {nodes.data(), packets.data()}; }
};

/// The tree of a mesh of at least one triangle, all indices valid. Time O(T log T), memory about
/// 200 bytes per triangle.
[[nodiscard]] TriangleTree build_triangle_tree(const TriangleMesh& mesh);

}  // namespace mortise
