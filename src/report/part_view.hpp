// SPDX-License-Identifier: GPL-3.0-or-later
// From where two parts are best looked at.
#pragma once

#include <Eigen/Core>

#include "mortise/parts/triangle_mesh.hpp"

namespace mortise::detail {

// A rotation whose rows point to the right, upward and toward the viewer, fixed frame: obliquely
// from above, as drawings show parts. Upward is the direction `away` (from the fixed part to the
// moving one), or rather what comes nearest to it of the fixed part's three main directions: the
// normals of its flat faces by area, z for parts without any.
[[nodiscard]] Eigen::Matrix3d part_view(const TriangleMesh& fixed, const Eigen::Vector3d& away);

}  // namespace mortise::detail
