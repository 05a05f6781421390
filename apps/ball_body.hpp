// SPDX-License-Identifier: GPL-3.0-or-later
// Any body as balls: a molecule, a part, or a file of balls.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>

#include "mortise/parts/solid.hpp"
#include "mortise/store/body.hpp"

namespace mortise::app {

struct BallBody {
  Eigen::Matrix4Xd balls;              ///< the body's own frame
  double error = 0.0;                  ///< bound on the Hausdorff distance of balls and body
  std::shared_ptr<const Solid> solid;  ///< exact distances of the body; only if asked for
};

struct BallBodyOptions {
  int grid = 64;          ///< parts: nodes along the longest side
  bool as_balls = true;   ///< fill in `balls` of a part
  bool as_solid = false;  ///< fill in `solid`
  bool quiet = false;     ///< do not tell what was repaired
  int threads = 0;
};

/// A molecule's heavy atoms with radii of their own, balls as they are, or a part's spherical
/// decomposition. @throws FileError, InputError as read_body() and decompose()
[[nodiscard]] BallBody read_ball_body(const std::string& spec, const BallBodyOptions& options);

/// "1502 triangles", "58 atoms", "310 balls".
[[nodiscard]] std::string size_text(const Body& body);

}  // namespace mortise::app
