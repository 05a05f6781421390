// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A mechanical part: its surface and the solid within.
#pragma once

#include <memory>

#include "mortise/parts/solid.hpp"
#include "mortise/parts/triangle_mesh.hpp"

namespace mortise {

/// One part, in its own frame and length unit.
struct Part {
  TriangleMesh mesh;                   ///< its surface
  std::shared_ptr<const Solid> solid;  ///< what answers distance and inclusion
};

}  // namespace mortise
