// SPDX-License-Identifier: GPL-3.0-or-later
// Balls inside a solid from its spherical decomposition.
#include "mortise/collision/collision_body.hpp"

#include <algorithm>
#include <limits>

#include "mortise/core/errors.hpp"
#include "mortise/parts/decompose.hpp"

namespace mortise {

CollisionBody collision_body(const Solid& solid, const CollisionBodyOptions& options) {
  const Decomposition parts = decompose(solid, {.grid = options.grid, .threads = options.threads});
  const Eigen::VectorXd distance = solid.signed_distance(parts.knots.points.topRows<3>(),
                                                         std::numeric_limits<double>::infinity());
  CollisionBody body{parts.knots, 0.0};
  for (Eigen::Index i = 0; i < distance.size(); ++i) {
    if (!(distance[i] < 0.0))
      throw InputError("collision_body: a ball's centre is not in the solid");
    double& radius = body.balls.points(3, i);
    const double inside = std::min(radius, -distance[i]);
    body.cover = std::max(body.cover, radius - inside + parts.epsilon);
    radius = inside;
  }
  return body;
}

}  // namespace mortise
