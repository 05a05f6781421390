// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Products and quotients of sets of rigid motions: obstacles, sweeps, places where a body fits in.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "mortise/collision/minkowski.hpp"
#include "mortise/core/rigid_motion.hpp"
#include "mortise/parts/solid.hpp"
#include "mortise/parts/triangle_mesh.hpp"

namespace mortise {

/// A set of rigid motions x' = R x + t by its sections: at each of some rotations a union of balls
/// of translations, the lifted form of [SD, Sec. 4.3].
struct Configurations {
  std::vector<Eigen::Quaterniond> rotations;  ///< K of unit norm; one may come several times
  std::vector<Balls> translations;            ///< K: 4 x N_k, centre and radius of t
};

/// A body put into SE(3): the motions at one rotation that carry the origin to a point of it.
[[nodiscard]] Configurations configurations_of_body(
    const Eigen::Matrix4Xd& balls,
    const Eigen::Quaterniond& rotation = Eigen::Quaterniond::Identity());

/// Single motions, each with a ball of this radius around its translation.
[[nodiscard]] Configurations configurations_of_motions(const std::vector<RigidMotion>& motions,
                                                       double tolerance = 0.0);

/// The inverses of all motions: balls at -R^T t.
[[nodiscard]] Configurations inverse(const Configurations& set);

/// {a b : a in A, b in B} [SD, Sec. 4.3]. Since (R, t)(Q, u) = (R Q, t + R u), the section at R Q
/// is the Minkowski sum of A's at R and B's at Q turned by R: all pairs of balls, with radii added.
/// Sections at one rotation (to 1e-9) become one.
///
///   sweep of a body S by motions M     the balls of M S, of all sections
///   obstacle of S and T at rotation R  the section of S T^-1 at R, S and T put into SE(3) at R and
///   1
///
/// @throws InputError as minkowski_sum, or unless counts agree and rotations are of unit norm
[[nodiscard]] Configurations configuration_product(const Configurations& a, const Configurations& b,
                                                   const MinkowskiOptions& options = {});

/// The balls of all sections.
[[nodiscard]] Balls all_translations(const Configurations& set);

/// How deep a body of balls lies in a solid at each motion: the most that all its balls may grow
/// and still lie in it, negative where one sticks out: min_j depth(R y_j + t) - s_j, exact as the
/// solid's distances are. The quotient of the solid by the body, all motions that carry the body
/// into the solid, is where this is >= 0: in lifted form, where the moved knots (y, s) lie below
/// the graph of the solid's depth.
/// @param balls  4 x N, N >= 1: centre and radius >= 0
/// @throws InputError on bad balls or motions
[[nodiscard]] Eigen::VectorXd containment_depth(const Solid& solid, const Eigen::Matrix4Xd& balls,
                                                const std::vector<RigidMotion>& motions,
                                                int threads = 0);

struct QuotientMeshOptions {
  double spacing = 0.0;  ///< of the grid of translations, length unit; 0 = the solid's longest
                         ///< side / 128
  int threads = 0;       ///< 0 = all cores; never changes the result
};

/// The section of that quotient at one rotation: the translations at which the body, turned by it,
/// lies in the solid; its boundary by surface_net(). No triangles if it fits nowhere.
/// @throws InputError on bad balls, rotation or options
[[nodiscard]] TriangleMesh quotient_mesh(const Solid& solid, const Eigen::Matrix4Xd& balls,
                                         const Eigen::Quaterniond& rotation,
                                         const QuotientMeshOptions& options = {});

}  // namespace mortise
