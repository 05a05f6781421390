// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// How often a part that is let go near its mate ends in it.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "mortise/assembly/assembly_session.hpp"
#include "mortise/core/rigid_motion.hpp"
#include "mortise/metrics/true_mates.hpp"
#include "mortise/parts/triangle_mesh.hpp"

namespace mortise {

struct LetGoOptions {
  int starts = 50;       ///< >= 1
  double shift = 0.15;   ///< largest distance of a start from the mate, part of the moving part's
                         ///< radius; >= 0
  double angle = 0.175;  ///< largest turn of a start, radians; >= 0
  std::uint64_t seed = 1;
  FollowOptions follow = {};
};

struct LetGoResult {
  Rest mate;           ///< where a part that starts at the true place comes to rest
  double drift = 0.0;  ///< of that from the true place, part of the radius
  bool holds = false;  ///< the drift is at most 0.2: further off, its rest is another one
  std::vector<RigidMotion> ends;  ///< where each start came to rest
  int home = 0;                   ///< of these within 2% of the radius and 2 degrees of the mate's
                                  ///< rest, or of that moved by the mate's symmetries
  int home_without_symmetries = 0;  ///< the same, symmetries not counted
};

/// Lets the moving part go from random places around its mate [HA, Sec. 5]. The starts are the same
/// for a seed everywhere.
/// @param moving    the moving part's surface, its input frame
/// @param truth     its place, with its symmetries
/// @param continues called before each start; false ends early, with the starts so far; may be
/// empty
/// @throws InputError if an option is out of range
[[nodiscard]] LetGoResult let_go(const AssemblySession& session, const TriangleMesh& moving,
                                 const TrueMate& truth, const LetGoOptions& options = {},
                                 const std::function<bool()>& continues = {});

}  // namespace mortise
