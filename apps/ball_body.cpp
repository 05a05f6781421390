// SPDX-License-Identifier: GPL-3.0-or-later
// What becomes of a body of each kind.
#include "ball_body.hpp"

#include <cstdio>

#include "mortise/parts/ball_union.hpp"
#include "mortise/parts/decompose.hpp"
#include "mortise/runs/body_forms.hpp"

namespace mortise::app {

BallBody read_ball_body(const std::string& spec, const BallBodyOptions& options) {
  const Body read = read_body(spec, {.threads = options.threads});
  BallBody body;
  const Part* part = read.part();
  if (part == nullptr) {
    body.balls = body_knots(read, {.radius = 0.0, .propensity = 0.0}, options.grid).points;
    if (options.as_solid) body.solid = std::make_shared<BallUnion>(body.balls);
    return body;
  }
  if (!options.quiet)
    for (const std::string& decision : read.decisions)
      std::fprintf(stderr, "mortise: %s: %s\n", spec.c_str(), decision.c_str());
  body.error = read.deviation;  // of a STEP file's triangles from its surface
  if (options.as_balls) {
    const Decomposition found =
        decompose(*part->solid, {.grid = options.grid, .threads = options.threads});
    body.balls = found.knots.points;
    body.error += found.epsilon;
  }
  if (options.as_solid) body.solid = part->solid;
  return body;
}

std::string size_text(const Body& body) {
  if (const Molecule* molecule = body.molecule())
    return std::to_string(molecule->atoms.size()) + " atoms";
  if (const Part* part = body.part()) return std::to_string(part->mesh.size()) + " triangles";
  return std::to_string(body.balls()->size()) + " balls";
}

}  // namespace mortise::app
