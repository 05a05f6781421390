// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies as balls and as parts.
#include "mortise/runs/body_forms.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "mortise/molecules/radii.hpp"
#include "mortise/parts/ball_mesh.hpp"
#include "mortise/parts/ball_union.hpp"
#include "mortise/parts/decompose.hpp"

namespace mortise {
namespace {

// Cuts of an icosahedron's edges: as fine as some 10^5 triangles allow. With n of them a triangle's
// middle lies 0.7 / n^2 of the radius or less inside its ball.
int cuts_of(Eigen::Index balls) {
  return static_cast<int>(std::clamp(std::sqrt(2e4 / static_cast<double>(balls)), 4.0, 32.0));
}

// Of a mesh of whole balls what bounds their union: triangles whose middle lies in no other ball.
TriangleMesh outer_triangles(const TriangleMesh& mesh, const BallUnion& solid, double allowance) {
  Eigen::Matrix3Xd middles(3, mesh.size());
  for (Eigen::Index t = 0; t < mesh.size(); ++t)
    middles.col(t) =
        (mesh.vertices.col(mesh.triangles(0, t)) + mesh.vertices.col(mesh.triangles(1, t)) +
         mesh.vertices.col(mesh.triangles(2, t))) /
        3.0;
  const Eigen::VectorXd distance =
      solid.signed_distance(middles, std::numeric_limits<double>::infinity());
  TriangleMesh outer{mesh.vertices, Eigen::Matrix3Xi(3, mesh.size())};
  Eigen::Index count = 0;
  for (Eigen::Index t = 0; t < mesh.size(); ++t)
    if (distance[t] > -allowance) outer.triangles.col(count++) = mesh.triangles.col(t);
  outer.triangles.conservativeResize(3, count);
  return outer;
}

Part ball_part(const Eigen::Matrix4Xd& balls) {
  auto solid = std::make_shared<BallUnion>(balls);
  const int cuts = cuts_of(balls.cols());
  const double allowance = 0.7 / (cuts * cuts) * balls.row(3).maxCoeff();
  Part part{outer_triangles(ball_mesh(balls, cuts), *solid, allowance), nullptr};
  part.solid = std::move(solid);
  return part;
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
