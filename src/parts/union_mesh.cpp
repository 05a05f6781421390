// SPDX-License-Identifier: GPL-3.0-or-later
// Distances of a union near its boundary, and their zero level.
#include "mortise/parts/union_mesh.hpp"

#include <cmath>
#include <limits>
#include <string>

#include "mortise/core/errors.hpp"
#include "mortise/parts/surface_net.hpp"
#include "parts/envelope_grid.hpp"
#include "parts/level_nodes.hpp"

namespace mortise {

TriangleMesh union_mesh(const Eigen::Matrix4Xd& balls, const UnionMeshOptions& options) {
  if (balls.cols() == 0 || balls.cols() > std::numeric_limits<std::int32_t>::max())
    throw InputError("union_mesh: expected 1 to 2^31 - 1 balls, got " +
                     std::to_string(balls.cols()));
  if (!balls.allFinite() || balls.row(3).minCoeff() < 0.0)
    throw InputError("union_mesh: balls must be finite with radii >= 0");
  Eigen::AlignedBox3d box;
  for (const auto ball : balls.colwise()) {
    box.extend(Eigen::Vector3d(ball.head<3>().array() - ball[3]));
    box.extend(Eigen::Vector3d(ball.head<3>().array() + ball[3]));
  }
  const GridNodes nodes = parts::level_nodes(box, options.spacing, "union_mesh");
  return surface_net(
      parts::envelope_grid(nodes, static_cast<std::int32_t>(balls.cols()), options.threads,
                           [&](const std::vector<std::int32_t>& which, const Eigen::Vector3d& at,
                               std::vector<double>& values) {
                             values.resize(which.size());
                             for (std::size_t n = 0; n < which.size(); ++n) {
                               const auto ball = balls.col(which[n]);
                               values[n] = (ball.head<3>() - at).norm() - ball[3];
                             }
                           }));
}

}  // namespace mortise
