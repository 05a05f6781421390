// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Whether a mesh has an open edge.
#pragma once

#include "mortise/parts/triangle_mesh.hpp"

namespace mortise {

/// True if each edge is used as often one way as the other, vertices at the same place being one.
[[nodiscard]] bool is_closed(const TriangleMesh& mesh);

}  // namespace mortise
