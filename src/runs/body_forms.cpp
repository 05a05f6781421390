// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies as balls and as parts.
#include "mortise/runs/body_forms.hpp"

#include <memory>

#include "mortise/molecules/radii.hpp"
#include "mortise/parts/ball_union.hpp"
#include "mortise/parts/decompose.hpp"
#include "mortise/parts/union_mesh.hpp"

namespace mortise {
namespace {

Part ball_part(const Eigen::Matrix4Xd& balls) {
  return {union_mesh(balls), std::make_shared<BallUnion>(balls)};
}

}  // namespace

Knots body_knots(const Body& body, const ToKnotsOptions& options, int ball_grid) {
  if (const Molecule* molecule = body.molecule()) return to_knots(*molecule, options);
  if (const Knots* balls = body.balls()) return *balls;
  return decompose(*body.part()->solid,
                   {.grid = ball_grid, .weights = KnotWeights::kShare, .threads = options.threads})
      .knots;
}

Part body_part(const Body& body) {
  if (const Part* part = body.part()) return *part;
  if (const Knots* balls = body.balls()) return ball_part(balls->points);
  return ball_part(atom_balls(*body.molecule()));
}

}  // namespace mortise
